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
/// the viewing direction. A hierarchy of bounding boxes leaves out segments that cannot meet.
std::vector<Crossing> crossings_of(const Points& polygon, const Mat3& rotation);
std::vector<Crossing> crossings_between(const Points& first, const Points& second, const Mat3& rotation);

/// The own strand of one overhand of a fisherman's loop, which is tied into one end of the rod. Along the load axis the
/// strand rises to the coil's outermost point, falls to its innermost and rises again as the tail. "High" means
/// outwards, away from the other knot.
///
/// A coil of n windings falls from one winding to the next. As it tightens, its windings may lie aslant, so that the
/// strand rises and falls again within each of them. Up to `own_rises` rises that end below the coil's outermost point
/// plus h therefore belong to the coil. The tail is the first rise that ends higher, or else the last rise. A single
/// winding has no rises of its own, because otherwise a tail that turns back low would be followed too far. Even so,
/// rises of a coil may end higher, and a single winding may lie aslant: a caller that knows the knot can have a number
/// of rises passed over, however high they are.
struct OverhandStrand {
  Eigen::Index begin = 0;  ///< node of the standing part from which the strand was followed, on this side of the roller
  Eigen::Index top = 0;    ///< node of the coil's outermost point, where the strand turns back
  Eigen::Index cut = 0;    ///< node of the tail at the height of `top` plus h, or where the tail turns back before
  Eigen::Index end = 0;    ///< node of the tail's end
  double level = 0.0;      ///< height of the coil's outermost point plus h, or of the cut where that is higher [m]
  bool coil_found = false;  ///< the strand turns back and forth as an overhand's does

  static int own_rises(int windings) { return windings > 1 ? windings : 0; }

  /// `standing`: a node in the standing part of the lower knot (k = 0), tied into the rod's first end, or of the upper
  /// (k = 1), tied into its last. That node may have gone around the roller behind the other knot; the strand is then
  /// followed down from it to where it rises again. `axis`: unit, from the lower grip to the upper one. `radius`: h
  /// [m]. `windings`: n. `passed_over`: number of rises that belong to the coil, however high they are.
  static OverhandStrand follow(const Points& points, std::size_t k, Eigen::Index standing, const Vec3& axis,
                               double radius, int windings = 1, int passed_over = 0);
};

}  // namespace knot_utm
