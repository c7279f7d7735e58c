#pragma once

#include <ros/node_handle.h>

#include <string>

#include "knot_utm/method/method.hpp"

namespace knot_utm {

/// Largest number of specimens in a batch under ROS. All of them are drawn before the first is tested, which takes
/// about 15 ms for each, and the machine answers nobody meanwhile.
inline constexpr int kMostInBatch = 1000;

/// The reason that utm_node gives for the end of a test in which knot_node died. The specimen is not to blame for it.
inline constexpr char kPhysicsDied[] = "knot_node died during the test";

/// Which specimen of a batch a test takes.
struct BatchPlace {
  int number = 1;  ///< of the specimen, from 1
  int count = 1;   ///< specimens of the batch; 1: the test stands alone

  bool alone() const { return count == 1; }
  /// "specimen 2 of 8"
  std::string text() const;
  friend bool operator==(const BatchPlace& a, const BatchPlace& b) {
    return a.number == b.number && a.count == b.count;
  }
};

/// What a test is: its method, its specimen and its folder. utm_node sets it as one parameter before the first command
/// of each test, and the other nodes read it when that command arrives. All of them thus test by the same method,
/// whatever has become of its files meanwhile.
struct TestOrder {
  BatchPlace place;    ///< of the specimen
  std::string name;    ///< of the method
  std::string method;  ///< of the whole batch, as method_yaml writes it
  std::string out;     ///< folder that was asked for, an absolute path

  bool same_specimen(const TestOrder& other) const { return place == other.place && method == other.method; }
};

/// The command that tests the specimens of a batch which have not been tested, with the tool that stands beside this
/// program.
std::string command_to_resume(const std::string& batch);

/// The order for a specimen of this method.
TestOrder order_of(const Method& method, const std::string& out, const BatchPlace& place);

/// The method of the whole batch. Throws InvalidInput.
Method method_of(const TestOrder& order);

/// Sets the parameter. False where the ROS master does not answer.
bool give_order(const ros::NodeHandle& node, const TestOrder& order);

/// Reads the parameter. Throws InvalidInput where it is not there, or none that utm_node sets.
TestOrder given_order(const ros::NodeHandle& node);

}  // namespace knot_utm
