#pragma once

#include <string>

#include "knot_utm/method/method.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// The machine of a method as URDF, for the parameter robot_description. Its links are the frames of conversions.hpp,
/// and its only joint that moves is the one in utm/joint_states. Its shapes are those of the grips, as in knot/markers.
///
/// `lower_grip`, `upper_grip`: where the grips stand before the test [m]. The upper grip is fixed to the crosshead
/// there. On mounting it is let down onto the loop, and a compliant frame gives way: only its frame shows that.
std::string machine_urdf(const Method& method, const Vec3& lower_grip, const Vec3& upper_grip);

}  // namespace knot_utm
