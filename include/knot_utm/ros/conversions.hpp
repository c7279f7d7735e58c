#pragma once

#include <geometry_msgs/WrenchStamped.h>
#include <knot_utm/Crosshead.h>
#include <knot_utm/KnotRecord.h>
#include <knot_utm/KnotShape.h>
#include <knot_utm/KnotState.h>
#include <ros/time.h>
#include <sensor_msgs/JointState.h>

#include <cstdint>
#include <string>

#include "knot_utm/analysis/motion_pattern.hpp"
#include "knot_utm/io/record.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/rod/rod.hpp"

namespace knot_utm {

/// Stamp of test time `time` [s] where the test began at `start` [s] on /clock. Never 0, which ROS takes for "no time".
ros::Time test_stamp(double start, double time);

/// Phase by the name that `phase_name` gives it; throws std::invalid_argument for any other.
Phase phase_from_name(const std::string& name);

/// To messages and back without the loss of a bit.
Crosshead to_message(const Command& command, std::uint32_t run, const ros::Time& stamp);
Command from_message(const Crosshead& message);
KnotState to_message(const Sample& sample, std::uint32_t run, const ros::Time& stamp);
Sample from_message(const KnotState& message);

/// What an answer says of the motion pattern so far.
void put_motion(const MotionPatternTracker& motion, KnotState& message);

KnotShape to_message(const Points& points, const Eigen::VectorXd& tension, double radius);
Points points_from_message(const KnotShape& message);
Record from_message(const KnotRecord& message);

/// The load cell's reading as force along z of the cell's frame, tension positive.
geometry_msgs::WrenchStamped to_wrench(const Sample& sample, const ros::Time& stamp);

/// The crosshead as a prismatic joint: displacement [m], velocity [m/s], load [N].
sensor_msgs::JointState to_joint_state(const Command& command, const Sample& sample, const ros::Time& stamp);

}  // namespace knot_utm
