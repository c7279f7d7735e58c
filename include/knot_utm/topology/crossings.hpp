#pragma once

#include <vector>

#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// A place where segments of closed polygons cross in projection. Segment i runs from point i to the next one.
struct Crossing {
  Eigen::Index over, under;              ///< segments
  double over_fraction, under_fraction;  ///< places on them
  bool positive;                         ///< turning the upper strand to the left brings it onto the lower one
  bool first_over;                       ///< the upper segment is the first polygon's
};

/// Crossings of a closed polygon with itself and of two with each other, in any order. The third row of `rotation` is
/// the viewing direction. Boxes around ever longer pieces leave out pieces that cannot meet.
std::vector<Crossing> crossings_of(const Points& polygon, const Mat3& rotation);
std::vector<Crossing> crossings_between(const Points& first, const Points& second, const Mat3& rotation);

}  // namespace knot_utm
