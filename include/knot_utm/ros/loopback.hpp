#pragma once

namespace knot_utm {

/// To be called before ros::init. Sets ROS_HOSTNAME to localhost if neither ROS_HOSTNAME nor ROS_IP is set, so that
/// this node listens on the loopback interface only. ROS 1 has no authentication: whoever can reach a node can command
/// it.
void prefer_loopback();

/// To be called after ros::start. Throws InvalidInput where this node or the master can be reached from another
/// machine, that is, where one of their sockets listens on an address that is not loopback.
void require_loopback();

/// Whether the ROS master accepts connections.
bool master_answers();

}  // namespace knot_utm
