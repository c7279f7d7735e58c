#pragma once

#include <optional>
#include <vector>

#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// A box with edges along x, y and z, between two corners.
struct Box {
  Vec3 low, high;  ///< [m]

  Vec3 middle() const { return 0.5 * (low + high); }
  void take_in(const Vec3& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  static Box around(const Vec3& middle, const Vec3& half) { return {middle - half, middle + half}; }
};

/// The places of the knots, found from the centreline alone: where strands touch each other and, among these places,
/// where they are bent most.
struct KnotPlaces {
  Vec3 lower, upper;  ///< centres of the two knots; of a single knot those of its two halves [m]
  Box all;            ///< contains both knots; of a single knot its whole loop
};

/// Finds the knots. `two`: the specimen has two knots, as a fisherman's loop. Empty where no strand touches another.
/// `cuts`: edges between one rope and the next.
std::optional<KnotPlaces> find_knots(const Points& points, double radius, bool two, const std::vector<int>& cuts = {});

}  // namespace knot_utm
