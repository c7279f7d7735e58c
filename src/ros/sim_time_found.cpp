#include "knot_utm/ros/sim_time_found.hpp"

#include <ros/names.h>
#include <ros/param.h>

#include "knot_utm/ros/master_parameters.hpp"
#include "knot_utm/ros/names.hpp"

namespace knot_utm {

SimTimeFound::SimTimeFound()
    : parameter_(ros::names::resolve("/use_sim_time")), note_(ros::names::resolve(names::kSimTimeFound)) {
  ros::param::get(note_, found_);
}

SimTimeFound::~SimTimeFound() {
  // Nobody is told where it fails: the master may have ended first, and its parameters with it.
  if (found_ == "unset") delete_on_master(parameter_);
  if (found_ == "true" || found_ == "false") set_on_master(parameter_, XmlRpc::XmlRpcValue(found_ == "true"));
  if (!found_.empty()) delete_on_master(note_);
}

}  // namespace knot_utm
