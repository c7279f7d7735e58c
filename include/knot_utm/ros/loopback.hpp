#pragma once

namespace knot_utm {

/// To be called before ros::init. Sets ROS_HOSTNAME to localhost if neither ROS_HOSTNAME nor ROS_IP is set, so that
/// this node names itself so to others.
void prefer_loopback();

/// To be called after ros::start. Lets only this machine reach the sockets that this process listens on: roscpp's
/// XML-RPC server listens on every address, whatever ROS_HOSTNAME says, and ROS 1 has no authentication. Throws
/// InvalidInput where Linux does not allow it, as before its version 5.7.
void stay_on_loopback();

}  // namespace knot_utm
