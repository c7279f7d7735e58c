#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/WrenchStamped.h>
#include <knot_utm/Crosshead.h>
#include <knot_utm/KnotRecord.h>
#include <knot_utm/KnotShape.h>
#include <knot_utm/KnotState.h>
#include <knot_utm/SpecimenInfo.h>
#include <ros/time.h>
#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>

#include <cstdint>
#include <string>
#include <vector>

#include "knot_utm/analysis/motion_pattern.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/run/samples.hpp"

namespace knot_utm {

/// The stamp of test time `time` [s] in a test that began at `start` [s] on /clock. Never 0, which ROS takes for "no
/// time".
ros::Time test_stamp(double start, double time);

/// Conversions to messages and back. They preserve every bit. Those back throw std::invalid_argument where a message
/// says what no test can.
Crosshead to_message(const Command& command, std::uint32_t run, const ros::Time& stamp);
Command from_message(const Crosshead& message);
KnotState to_message(const Sample& sample, std::uint32_t run, const ros::Time& stamp);
Sample from_message(const KnotState& message);

/// Enters the motion pattern so far into a message.
void put_motion(const MotionPatternTracker& motion, KnotState& message);

geometry_msgs::Point to_point(const Vec3& place);

/// The rod after a command.
KnotShape to_message(const Points& points, const Eigen::VectorXd& tension, double radius, const Crosshead& command);
Points points_from_message(const KnotShape& message);
Record from_message(const KnotRecord& message);

/// Enters all but the stamp and who listens. `drawn`: the specimen's nodes before the test. `cuts`: edges between one
/// rope and the next.
void put_specimen(const Method& method, const Points& drawn, const std::vector<int>& cuts, SpecimenInfo& message);

/// "the test ended by break: the rod parted at ..."
std::string in_words(const TestEnd& end);

/// The reading of the load cell as a force along z of the frame of the cell, tension positive.
geometry_msgs::WrenchStamped to_wrench(const Sample& sample, const ros::Time& stamp);

/// The crosshead as a prismatic joint: displacement [m], velocity [m/s], load [N].
sensor_msgs::JointState to_joint_state(const Command& command, const Sample& sample, const ros::Time& stamp);

/// The frames of a test, all with the axes of `world`: world -> utm_base -> lower_grip, and utm_base -> crosshead ->
/// upper_grip -> load_cell. The second ones move, and so does utm_base -> knot. `crosshead`: where it stood at the
/// beginning of the test, above the lower grip by the distance of the grips [m].
tf2_msgs::TFMessage fixed_frames(const Vec3& lower_grip, const ros::Time& stamp);
tf2_msgs::TFMessage moving_frames(const Vec3& crosshead, double displacement, const Vec3& upper_grip, const Vec3& knot,
                                  const ros::Time& stamp);

/// The machine of a method as URDF, for the parameter robot_description. Its links are these frames,
/// and its only joint that moves is the one in utm/joint_states. Its shapes are those of the grips, as in knot/markers.
///
/// `lower_grip`, `upper_grip`: where the grips stand before the test [m]. The upper grip is fixed to the crosshead
/// there. On mounting it is let down onto the loop, and a compliant frame gives way: only its frame shows that.
std::string machine_urdf(const Method& method, const Vec3& lower_grip, const Vec3& upper_grip);

}  // namespace knot_utm
