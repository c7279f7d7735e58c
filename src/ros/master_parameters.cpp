#include "knot_utm/ros/master_parameters.hpp"

#include <XmlRpcClient.h>
#include <ros/duration.h>
#include <ros/master.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>

namespace knot_utm {
namespace {

constexpr int kTries = 3;         // of a call: on a busy machine a connection to the master may break
constexpr double kBetween = 0.1;  // wall time between two tries [s]

/// As ros::master::execute, which refuses once ROS is being shut down.
bool ask_once(const char* what, const XmlRpc::XmlRpcValue& request, XmlRpc::XmlRpcValue& answer) {
  XmlRpc::XmlRpcClient master(ros::master::getHost().c_str(), static_cast<int>(ros::master::getPort()), "/");
  XmlRpc::XmlRpcValue response;
  return master.execute(what, request, response) && !master.isFault() &&
         ros::XMLRPCManager::instance()->validateXmlrpcResponse(what, response, answer);
}

bool call(const char* what, const XmlRpc::XmlRpcValue& request, XmlRpc::XmlRpcValue& answer) {
  for (int tries = 1; !ask_once(what, request, answer); ++tries) {
    if (tries == kTries) return false;
    ros::WallDuration(kBetween).sleep();
  }
  return true;
}

XmlRpc::XmlRpcValue request_for(const std::string& name) {
  XmlRpc::XmlRpcValue request;
  request[0] = ros::this_node::getName();
  request[1] = name;
  return request;
}

}  // namespace

bool master_answers() {
  XmlRpc::XmlRpcValue request, answer;
  request[0] = ros::this_node::getName();
  return call("getPid", request, answer);
}

bool set_on_master(const std::string& name, const XmlRpc::XmlRpcValue& value) {
  XmlRpc::XmlRpcValue request = request_for(name), answer;
  request[2] = value;
  return call("setParam", request, answer);
}

bool delete_on_master(const std::string& name) {
  XmlRpc::XmlRpcValue answer;
  return call("deleteParam", request_for(name), answer);
}

std::optional<XmlRpc::XmlRpcValue> get_from_master(const std::string& name) {
  XmlRpc::XmlRpcValue value;
  if (!call("getParam", request_for(name), value)) return std::nullopt;
  return value;
}

}  // namespace knot_utm
