#pragma once

#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// The force between two strands at one integration point.
struct ContactForce {
  Vec3 place = Vec3::Zero();  ///< in the middle between the centrelines [m]
  Vec3 force = Vec3::Zero();  ///< g, pressure and friction, of one strand on the other; the reaction is -g [N]
};

}  // namespace knot_utm
