#include "knot_utm/ros/sim_time_found.hpp"

#include <XmlRpcClient.h>
#include <XmlRpcValue.h>
#include <ros/master.h>
#include <ros/names.h>
#include <ros/param.h>
#include <ros/this_node.h>

#include "knot_utm/ros/names.hpp"

namespace knot_utm {
namespace {

/// Nobody is told where it fails: the master may have ended first, and its parameters with it.
void ask_master(const char* what, const std::string& parameter, const XmlRpc::XmlRpcValue* value) {
  XmlRpc::XmlRpcClient master(ros::master::getHost().c_str(), static_cast<int>(ros::master::getPort()), "/");
  XmlRpc::XmlRpcValue request, answer;
  request[0] = ros::this_node::getName();
  request[1] = parameter;
  if (value != nullptr) request[2] = *value;
  master.execute(what, request, answer);
}

}  // namespace

SimTimeFound::SimTimeFound()
    : parameter_(ros::names::resolve("/use_sim_time")), note_(ros::names::resolve(names::kSimTimeFound)) {
  ros::param::get(note_, found_);
}

SimTimeFound::~SimTimeFound() {
  const XmlRpc::XmlRpcValue before(found_ == "true");
  if (found_ == "unset") ask_master("deleteParam", parameter_, nullptr);
  if (found_ == "true" || found_ == "false") ask_master("setParam", parameter_, &before);
  if (!found_.empty()) ask_master("deleteParam", note_, nullptr);
}

}  // namespace knot_utm
