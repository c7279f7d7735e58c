#pragma once

#include <Eigen/Core>

namespace knot_utm {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Points = Eigen::Matrix3Xd;  ///< one column a point [m]

}  // namespace knot_utm
