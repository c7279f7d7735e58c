#pragma once

#include <knot_utm/StartTest.h>
#include <ros/node_handle.h>

#include <functional>
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
///   test/data               record of an experiment, which is followed instead of the last pull, or without travel is
///                           beside it; empty: none
///   test/bag                a record that is beside the test where there is no test/data; empty: none
///   test/out                folder of the files [out/NAME of the method]
struct TestWords {
  std::string method, shipped_methods, material, preload, working_directory, data, bag, out;
  std::vector<std::string> overrides;
};

/// The setup of a test, which utm_node and knot_node read from the same parameters.
struct MethodSetup {
  TestWords words;
  Method method;
  std::string out;                   ///< absolute path
  std::string beside;                ///< a record for test.bag that is not followed; empty: none
  std::vector<std::string> notices;  ///< what was read of a record, as a user should see
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

/// What a test is, the folder that was asked for, an absolute path, and the record beside it. utm_node sets it as one
/// parameter before the first command of each test, and the other nodes read it when that command arrives. All of them
/// thus test by the same method, whatever has become of its files meanwhile.
struct TestOrder {
  Method method;
  std::string out, beside;
};
bool give_order(const ros::NodeHandle& node, const TestOrder& order);  ///< false: the ROS master does not answer
TestOrder given_order(const ros::NodeHandle& node);                    ///< throws InvalidInput where there is none

/// The reason that utm_node gives for the end of a test in which knot_node died.
inline constexpr char kPhysicsDied[] = "knot_node died during the test";

}  // namespace knot_utm
