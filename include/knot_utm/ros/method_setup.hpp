#pragma once

#include <ros/node_handle.h>

#include <sstream>
#include <string>

#include "knot_utm/io/method.hpp"
#include "knot_utm/machine/program_runner.hpp"

namespace knot_utm {

/// What the parameters of a test say. All nodes of a test read the same, relative to their namespace:
///   test/method             a method file: as given, or one of test/shipped_methods, with or without ".yaml"
///   test/shipped_methods    folder of the methods that come with the package
///   test/material           instead of the method's; empty: the method's
///   test/preload            specimen.preload [N]; empty: the method's
///   test/overrides          list of "dotted.key=YAML", after these two among paths as long
///   test/working_directory  where relative paths begin; empty: the node's own
///   test/data               record of an experiment, which is followed instead of the last pull; empty: none
///   test/out                folder of the files [out/NAME of the method]
///   test/network            true: other machines may reach the nodes
struct MethodSetup {
  Method method;
  std::string out;   ///< absolute
  std::string data;  ///< absolute; empty: none
};

/// Wrong input of which another node of the same launch says the line: the cause of a failure stands there once.
struct SaidByAnother : InvalidInput {
  explicit SaidByAnother(const InvalidInput& invalid) : InvalidInput(invalid) {}
};

/// Throws InvalidInput; in every node but utm_node, which reads the same, SaidByAnother where that one is launched,
/// too.
MethodSetup read_test_setup(const ros::NodeHandle& node);

/// A parameter where it is set; else `value` stays. Throws InvalidInput where it is not what `allowed` says.
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

/// Starts ROS as the node `name` of a test, on loopback unless the environment says otherwise. Throws InvalidInput
/// where other machines reach this node or the master and test/network is not true.
ros::NodeHandle join_ros(int argc, char** argv, const char* name);

/// Puts the node's exit code where watch_node looks for it, and ends ROS.
void leave_ros(const char* name, int code);

/// Runs `body` and says in one line what went wrong. Returns the exit code: 0, 1 failed, 2 wrong input.
template <class Body>
int run_node(int argc, char** argv, const char* name, Body body);

/// For `run_node`: whether the only argument is --version, which is answered then.
bool asks_for_version(int argc, char** argv);

/// For `run_node`: one line on the console, whether or not ROS logging is up.
int report_failure(const char* name, const char* what, int code);

template <class Body>
int run_node(int argc, char** argv, const char* name, Body body) {
  if (asks_for_version(argc, argv)) return 0;
  int code = 0;
  try {
    code = body();
  } catch (const SaidByAnother&) {
    code = 2;
  } catch (const InvalidInput& error) {
    code = report_failure(name, error.what(), 2);
  } catch (const std::exception& error) {
    code = report_failure(name, error.what(), 1);
  }
  leave_ros(name, code);
  return code;
}

}  // namespace knot_utm
