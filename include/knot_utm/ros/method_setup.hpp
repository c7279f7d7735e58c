#pragma once

#include <knot_utm/StartTest.h>
#include <ros/node_handle.h>

#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "knot_utm/method/method.hpp"

namespace knot_utm {

/// What a test is to be, in words. A launch says it by parameters, relative to its namespace, and a request of
/// utm/start_test or utm/run_test by the fields of the same names:
///   test/method             a method file: a path, or one of test/shipped_methods, with or without ".yaml"
///   test/shipped_methods    folder of the methods that come with the package
///   test/material           replaces the method's material; empty: the method's own
///   test/preload            replaces specimen.preload [N]; empty: the method's own
///   test/overrides          'dotted.key=YAML', 'dotted.key=YAML'; applied after test/material and test/preload where
///                           keys have equally many parts
///   test/working_directory  folder from which relative paths begin; empty: the node's own
///   test/data               record of an experiment, which is followed instead of the last pull; empty: none
///   test/out                folder of the files [out/NAME of the method]
struct TestWords {
  std::string method, shipped_methods, material, preload, working_directory, data, out;
  std::vector<std::string> overrides;
};

/// The setup of a test, which utm_node and knot_node read from the same parameters.
struct MethodSetup {
  TestWords words;
  std::string file;  ///< of the method
  Method method;
  std::string out;                ///< absolute path
  std::vector<std::string> told;  ///< what was read of a record, as a user should see
};

/// Reads the words by their names, without "test/". `word`: the word of a name; empty: it is not given. Throws
/// InvalidInput.
TestWords read_words(const std::function<std::string(const std::string& name)>& word);

/// Throws InvalidInput, also where the specimen cannot be made, the machine cannot hold it, or the method is one of
/// several specimens.
MethodSetup set_up(const TestWords& words);

/// The words of the launch with those that a request gives in their place.
TestWords asked_for(TestWords launched, const StartTest::Request& request);

/// Reads the setup from the parameters of the launch. Throws InvalidInput.
MethodSetup read_test_setup(const ros::NodeHandle& node);

/// What a test is. utm_node sets it as one parameter before the first command of each test, and the other nodes read it
/// when that command arrives. All of them thus test by the same method, whatever has become of its files meanwhile.
struct TestOrder {
  std::string name;    ///< of the method
  std::string method;  ///< as method_yaml writes it
  std::string out;     ///< folder that was asked for, an absolute path
};
TestOrder order_of(const Method& method, const std::string& out);
Method method_of(const TestOrder& order);                              ///< throws InvalidInput
bool give_order(const ros::NodeHandle& node, const TestOrder& order);  ///< false: the ROS master does not answer
TestOrder given_order(const ros::NodeHandle& node);                    ///< throws InvalidInput where there is none

/// The reason that utm_node gives for the end of a test in which knot_node died.
inline constexpr char kPhysicsDied[] = "knot_node died during the test";

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
/// code: 0 success, 1 failure, 2 invalid input. Before that, it answers --help and --version without a master, and
/// refuses every other word that is not for ROS itself (NAME:=VALUE). `help`: what --help prints below its usage line.
int run_node(int argc, char** argv, const char* name, const char* help, const std::function<int()>& body);

}  // namespace knot_utm
