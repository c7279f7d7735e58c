#include "knot_utm/ros/ask_master.hpp"

#include <XmlRpcClient.h>
#include <ros/duration.h>
#include <ros/master.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>

namespace knot_utm {

std::optional<XmlRpc::XmlRpcValue> ask_master(const char* call, const std::vector<XmlRpc::XmlRpcValue>& words) {
  constexpr int kTries = 3;         // on a busy machine a connection to the master may break
  constexpr double kBetween = 0.1;  // wall time between two tries [s]
  XmlRpc::XmlRpcValue request, response, answer;
  request[0] = ros::this_node::getName();
  for (std::size_t i = 0; i < words.size(); ++i) request[static_cast<int>(i) + 1] = words[i];
  for (int tries = 0; tries < kTries; ++tries) {
    if (tries > 0) ros::WallDuration(kBetween).sleep();
    // As ros::master::execute, which refuses once ROS is being shut down.
    XmlRpc::XmlRpcClient master(ros::master::getHost().c_str(), static_cast<int>(ros::master::getPort()), "/");
    if (master.execute(call, request, response) && !master.isFault() &&
        ros::XMLRPCManager::instance()->validateXmlrpcResponse(call, response, answer))
      return answer;
  }
  return std::nullopt;
}

}  // namespace knot_utm
