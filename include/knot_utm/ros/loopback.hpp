#pragma once

namespace knot_utm {

/// To be called before ros::init. Sets ROS_HOSTNAME to localhost if neither ROS_HOSTNAME nor ROS_IP is set, so that
/// this node names itself so to others, and rosmaster, roslaunch and nodes in Python listen on loopback only. ROS 1 has
/// no authentication: whoever can reach a node can command it.
void prefer_loopback();

/// To be called after ros::start. Lets only this machine reach the sockets that this process listens on: roscpp's
/// XML-RPC server listens on every address, whatever ROS_HOSTNAME says. Linux before 5.7 does not allow it to every
/// user.
void stay_on_loopback();

/// To be called after `stay_on_loopback`. Throws InvalidInput where this node or the master can be reached from another
/// machine, that is, where one of their sockets listens on an address that is not loopback, and not on the loopback
/// device alone.
void require_loopback();

/// Whether the ROS master accepts connections.
bool master_answers();

}  // namespace knot_utm
