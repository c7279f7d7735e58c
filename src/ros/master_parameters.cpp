#include "knot_utm/ros/master_parameters.hpp"

#include <ros/duration.h>
#include <ros/master.h>
#include <ros/this_node.h>

namespace knot_utm {
namespace {

constexpr int kTries = 3;         // of a call: on a busy machine a connection to the master may break
constexpr double kBetween = 0.1;  // wall time between two tries [s]

bool call(const char* what, const XmlRpc::XmlRpcValue& request, XmlRpc::XmlRpcValue& answer) {
  XmlRpc::XmlRpcValue response;
  for (int tries = 1; !ros::master::execute(what, request, response, answer, false); ++tries) {
    if (tries == kTries) return false;
    ros::WallDuration(kBetween).sleep();
  }
  return true;
}

}  // namespace

bool set_on_master(const std::string& name, const XmlRpc::XmlRpcValue& value) {
  XmlRpc::XmlRpcValue request, answer;
  request[0] = ros::this_node::getName();
  request[1] = name;
  request[2] = value;
  return call("setParam", request, answer);
}

std::optional<XmlRpc::XmlRpcValue> get_from_master(const std::string& name) {
  XmlRpc::XmlRpcValue request, value;
  request[0] = ros::this_node::getName();
  request[1] = name;
  if (!call("getParam", request, value)) return std::nullopt;
  return value;
}

}  // namespace knot_utm
