#pragma once

#include <Eigen/Core>

namespace knot_utm {

/// What contacts press on each node with: the sum of their normal forces [N], and in the last row the sum of the sizes
/// of these. Strands that squeeze a node between them cancel in the first, and add up in the second.
using Pressing = Eigen::Matrix4Xd;

}  // namespace knot_utm
