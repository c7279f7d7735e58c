#pragma once

#include <ros/node_handle.h>

#include <string>

#include "knot_utm/io/method.hpp"
#include "knot_utm/ros/batch_place.hpp"

namespace knot_utm {

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

/// The order for a specimen of this method.
TestOrder order_of(const Method& method, const std::string& out, const BatchPlace& place);

/// The method of the whole batch. Throws InvalidInput.
Method method_of(const TestOrder& order);

/// Sets the parameter. False where the ROS master does not answer.
bool give_order(const ros::NodeHandle& node, const TestOrder& order);

/// Reads the parameter. Throws InvalidInput where it is not there, or none that utm_node sets.
TestOrder given_order(const ros::NodeHandle& node);

}  // namespace knot_utm
