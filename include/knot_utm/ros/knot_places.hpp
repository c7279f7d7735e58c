#pragma once

#include <optional>

#include "knot_utm/rod/rod.hpp"

namespace knot_utm {

/// What lies between two corners, its edges along x, y and z.
struct Box {
  Vec3 low, high;  ///< [m]

  Vec3 middle() const { return 0.5 * (low + high); }
  void take_in(const Vec3& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  static Box around(const Vec3& middle, const Vec3& half) { return {middle - half, middle + half}; }
};

/// Where the knots are, as far as the centreline alone tells: where strands lie against each other, and there where
/// they are bent most.
struct KnotPlaces {
  Vec3 lower, upper;  ///< middles of the two knots; of a single one those of its halves [m]
  Box all;            ///< holds both; of a single knot its whole loop
};

/// `two`: a fisherman's knot. None where no strand lies against another.
std::optional<KnotPlaces> find_knots(const Points& points, double radius, bool two);

}  // namespace knot_utm
