#pragma once

#include <XmlRpcValue.h>
#include <ros/node_handle.h>

#include <chrono>
#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {

/// The main functions of the nodes. Each returns the exit code of its process.
int run_utm_node(int argc, char** argv);       ///< the machine
int run_knot_node(int argc, char** argv);      ///< the physics
int run_recorder_node(int argc, char** argv);  ///< writes what a test measures

/// Runs `body` as the main function of a node. Where it throws, prints one line and ends the launch. Returns the exit
/// code: 0 success, 1 failure, 2 invalid input. Before that, it answers --help and --version without a master, and
/// refuses every other word that is not for ROS itself (NAME:=VALUE). `help`: what --help prints below its usage line.
int run_node(int argc, char** argv, const char* name, const char* help, const std::function<int()>& body);

/// Starts ROS as the node `name` of a test. Other machines can reach it only where test/network is true: throws
/// InvalidInput where Linux does not allow a program to keep them away, as before its version 5.7. If the roslaunch
/// that started this process is killed, this process is interrupted as by Ctrl-C: nobody else would end it.
ros::NodeHandle join_ros(int argc, char** argv, const char* name);

/// Reads a parameter into `value`, which stays as it is where the parameter is not set. Throws InvalidInput where it
/// has the wrong type; `allowed` says what is allowed.
template <class Value>
void read_parameter(const ros::NodeHandle& node, const std::string& name, Value* value, const char* allowed) {
  if (node.hasParam(name) && !node.getParam(name, *value)) {
    XmlRpc::XmlRpcValue given;
    node.getParam(name, given);
    std::ostringstream text;
    given.write(text);
    throw InvalidInput(node.resolveName(name), text.str(), allowed);
  }
}

/// What the ROS master answers to a call such as "getParam", after the name of this node, with these words. Empty where
/// it refuses, or does not answer. It is not waited for, also where ROS is being shut down: roscpp's own setParam waits
/// for ever for a master that died, and does nothing once ROS is being shut down.
std::optional<XmlRpc::XmlRpcValue> ask_master(const char* call, const std::vector<XmlRpc::XmlRpcValue>& words = {});

/// Sets the parameter of this absolute name. Returns whether the master has it.
bool set_parameter(const std::string& name, const XmlRpc::XmlRpcValue& value);

/// Puts the parameter /use_sim_time, which launch files set, back to what launch/check found there before the launch:
/// "unset", "true" or "false"; empty: not known. ROS need not be running any more.
void put_back_sim_time(const std::string& found);

/// To be called when the test is over. Ends the launch as Ctrl-C does, and returns when that has reached this node.
/// roslaunch itself ends only where a required node ends, and calls that a death, even after a success.
void end_launch();

/// As `end_launch`, once the window of the node rviz is closed, where there is one.
void end_launch_when_rviz_is_closed();

/// Writes how the test ended to the file that the launch argument `verdict` names, for scripts/tighten: in the first
/// line the exit code, which is empty until the test is over, and in the second the folder. `file`: empty: none.
void write_verdict(const std::string& file, std::optional<int> code, const std::string& folder);

/// The wall time that has passed since then [s].
inline double seconds_since(std::chrono::steady_clock::time_point then) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

}  // namespace knot_utm
