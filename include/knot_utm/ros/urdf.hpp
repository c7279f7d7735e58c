#pragma once

#include <string>

#include "knot_utm/io/method.hpp"
#include "knot_utm/rod/rod.hpp"

namespace knot_utm {

/// The machine of a method as URDF, for the parameter robot_description. Its links are the frames of MachineFrames, and
/// its only joint that moves is the one in utm/joint_states. Grips have the size that the method gives them; base,
/// columns, crosshead and load cell are drawn in proportion to them.
///
/// `lower_grip`: where the lower grip stands [m].
std::string machine_urdf(const Method& method, const Vec3& lower_grip);

}  // namespace knot_utm
