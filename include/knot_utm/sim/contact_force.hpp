#pragma once

#include "knot_utm/rod/rod.hpp"

namespace knot_utm {

/// What two strands exert on each other at one point of integration.
struct ContactForce {
  Vec3 place = Vec3::Zero();  ///< in the middle between the centrelines [m]
  Vec3 force = Vec3::Zero();  ///< g, pressure and friction, of one strand on the other; the opposite comes back [N]
};

}  // namespace knot_utm
