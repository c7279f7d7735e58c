#pragma once

#include <knot_utm/StartTest.h>
#include <ros/node_handle.h>

#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "knot_utm/machine/program_runner.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/raw/raw_options.hpp"

namespace knot_utm {

/// What a test is to be, in words. A launch says it by parameters, relative to its namespace, and a request of
/// utm/start_test by the fields of the same names:
///   test/method             a method file: a path, or one of test/shipped_methods, with or without ".yaml"
///   test/shipped_methods    folder of the methods that come with the package
///   test/material           replaces the method's material; empty: the method's own
///   test/preload            replaces specimen.preload [N]; empty: the method's own
///   test/overrides          list of "dotted.key=YAML"; applied after test/material and test/preload where keys have
///                           equally many parts
///   test/working_directory  folder from which relative paths begin; empty: the node's own
///   test/data               record of an experiment, which is followed instead of the last pull; empty: none
///   test/columns, test/units, test/specimen, test/invert
///                           how its raw data are to be read, as the options of compare say it; empty: as they stand
///   test/out                folder of the files [out/NAME of the method]
struct TestWords {
  std::string method, shipped_methods, material, preload, working_directory, data, out;
  RecordWords record;
  std::vector<std::string> overrides;
};

/// The setup of a test. All nodes of a launch read the same parameters, and test/network: true lets other machines
/// reach the nodes.
struct MethodSetup {
  TestWords words;
  std::string file;  ///< of the method
  Method method;
  std::string out;                ///< absolute path
  std::string data;               ///< absolute path of the record; empty: there is none
  std::vector<CurveRow> record;   ///< its readings
  std::vector<std::string> told;  ///< what of it was read, as a user should see
};

/// Throws InvalidInput.
MethodSetup set_up(const TestWords& words);

/// The words of the launch with those that a request gives in their place.
TestWords asked_for(TestWords launched, const StartTest::Request& request);

/// Invalid input that another node of the same launch reports. The cause of a failure is thus printed once.
struct SaidByAnother : InvalidInput {
  explicit SaidByAnother(const InvalidInput& invalid) : InvalidInput(invalid) {}
};

/// Reads the setup. Throws InvalidInput. In nodes other than utm_node it throws SaidByAnother where utm_node, which
/// reads the same parameters, is launched too.
MethodSetup read_test_setup(const ros::NodeHandle& node);

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

/// Starts ROS as the node `name` of a test. Other machines can reach it only where test/network is true.
ros::NodeHandle join_ros(int argc, char** argv, const char* name);

/// Runs `body` as the main function of a node. Where it throws, prints one line and ends the launch. Returns the exit
/// code: 0 success, 1 failure, 2 invalid input. `help`: see `answer_words`.
int run_node(int argc, char** argv, const char* name, const char* help, const std::function<int()>& body);

/// For main functions, before anything of ROS is asked for: answers --help and --version, and refuses every other word
/// that is not for ROS itself (NAME:=VALUE). Returns the exit code; nothing where the node is to run. `help`: what it
/// prints below its usage line.
std::optional<int> answer_words(int argc, char** argv, const char* name, const char* help);

}  // namespace knot_utm
