#include "knot_utm/ros/master_parameters.hpp"

#include <ros/master.h>
#include <ros/this_node.h>

namespace knot_utm {

bool set_on_master(const std::string& name, const XmlRpc::XmlRpcValue& value) {
  XmlRpc::XmlRpcValue request, response, payload;
  request[0] = ros::this_node::getName();
  request[1] = name;
  request[2] = value;
  return ros::master::execute("setParam", request, response, payload, false);
}

std::optional<XmlRpc::XmlRpcValue> get_from_master(const std::string& name) {
  XmlRpc::XmlRpcValue request, response, value;
  request[0] = ros::this_node::getName();
  request[1] = name;
  if (!ros::master::execute("getParam", request, response, value, false)) return std::nullopt;
  return value;
}

}  // namespace knot_utm
