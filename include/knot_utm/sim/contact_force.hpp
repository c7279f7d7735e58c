#pragma once

#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// The force between two strands at one integration point.
struct ContactForce {
  Vec3 place = Vec3::Zero();  ///< in the middle between the centrelines [m]
  Vec3 force = Vec3::Zero();  ///< g, pressure and friction, of one strand on the other; the reaction is -g [N]
};

/// What contacts press on each node with: the sum of their normal forces [N], and in the last row the sum of the sizes
/// of these. Strands that squeeze a node between them cancel in the first, and add up in the second.
using Pressing = Eigen::Matrix4Xd;

}  // namespace knot_utm
