#include "knot_utm/ros/launched.hpp"

#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/names.h>
#include <ros/param.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <fstream>

#include "knot_utm/ros/ask_master.hpp"
#include "knot_utm/ros/names.hpp"

namespace knot_utm {
namespace {

using XmlRpc::XmlRpcValue;

constexpr double kLookAtLaunch = 0.2;  // wall time between two looks at the launch [s]

bool launched() {
  std::ifstream file("/proc/" + std::to_string(getppid()) + "/cmdline");
  for (std::string word; std::getline(file, word, '\0');)
    if (word == "roslaunch" || word.find("/roslaunch") != std::string::npos) return true;
  return false;
}

void wait() { ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kLookAtLaunch)); }

}  // namespace

void end_with_launch() {
  if (launched()) prctl(PR_SET_PDEATHSIG, SIGINT);
}

void end_launch() {
  if (!launched()) return;
  kill(getppid(), SIGINT);
  while (ros::ok()) wait();
}

void end_launch_when_rviz_is_closed() {
  const auto is_open = [rviz = ros::names::resolve("rviz")] {
    return ros::ok() && ask_master("lookupNode", {XmlRpcValue(rviz)});
  };
  if (is_open()) ROS_INFO("the test is over; the launch ends when the window of rviz is closed");
  std::fflush(stdout);  // where this is no terminal it would be seen at the end only
  while (is_open()) wait();
  end_launch();
}

void write_verdict(const std::string& file, std::optional<int> code, const std::string& folder) {
  if (file.empty()) return;
  std::ofstream out(file);
  out << (code ? std::to_string(*code) : "") << '\n' << folder << '\n';
  out.close();
  if (!out) ROS_ERROR("cannot write %s", file.c_str());
}

SimTimeFound::SimTimeFound()
    : parameter_(ros::names::resolve("/use_sim_time")), note_(ros::names::resolve(names::kSimTimeFound)) {
  ros::param::get(note_, found_);
}

SimTimeFound::~SimTimeFound() {
  // Nobody is told where it fails: the master may have ended first, and its parameters with it.
  if (found_ == "unset") ask_master("deleteParam", {XmlRpcValue(parameter_)});
  if (found_ == "true" || found_ == "false")
    ask_master("setParam", {XmlRpcValue(parameter_), XmlRpcValue(found_ == "true")});
  if (!found_.empty()) ask_master("deleteParam", {XmlRpcValue(note_)});
}

}  // namespace knot_utm
