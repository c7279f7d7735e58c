#pragma once

namespace knot_utm {

/// Before ros::init: with neither ROS_HOSTNAME nor ROS_IP set, ROS_HOSTNAME is localhost, so that this node listens on
/// loopback only. ROS 1 has no authentication: whoever reaches a node commands it.
void prefer_loopback();

/// After ros::start: throws InvalidInput where this node or the master can be reached from another machine. They can
/// where a socket of theirs listens on an address that is not loopback.
void require_loopback();

/// Whether the ROS master takes connections.
bool master_answers();

}  // namespace knot_utm
