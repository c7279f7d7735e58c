#include "knot_utm/ros/order_of_test.hpp"

#include <XmlRpcException.h>

#include <optional>

#include "knot_utm/ros/master_parameters.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/run/command_hint.hpp"

namespace knot_utm {
namespace {

using XmlRpc::XmlRpcValue;

constexpr char kNumber[] = "number", kCount[] = "count", kName[] = "name", kMethod[] = "method", kOut[] = "out";

}  // namespace

std::string BatchPlace::text() const { return "specimen " + std::to_string(number) + " of " + std::to_string(count); }

std::string command_to_resume(const std::string& batch) {
  return command_line({program_beside("tensile_test"), "--resume", batch});
}

TestOrder order_of(const Method& method, const std::string& out, const BatchPlace& place) {
  Method of_batch = method;
  of_batch.specimens.count = place.count;
  return {place, method.name, method_yaml(of_batch), out};
}

Method method_of(const TestOrder& order) { return parse_method(order.method, order.name + ".yaml"); }

bool give_order(const ros::NodeHandle& node, const TestOrder& order) {
  XmlRpcValue value;
  value[kNumber] = order.place.number;
  value[kCount] = order.place.count;
  value[kName] = order.name;
  value[kMethod] = order.method;
  value[kOut] = order.out;
  return set_on_master(node.resolveName(names::kTestOrder), value);
}

TestOrder given_order(const ros::NodeHandle& node) {
  const std::string name = node.resolveName(names::kTestOrder);
  std::optional<XmlRpcValue> set = get_from_master(name);
  // Without it nobody knows which specimen is meant: the test is then not taken for one that stands alone.
  if (!set || set->getType() != XmlRpcValue::TypeStruct)
    throw InvalidInput::sentence(
        name, "",
        "cannot read the parameter " + name +
            ", which utm_node sets before each test: it is not there, or the ROS master does not answer");
  TestOrder order;
  try {
    XmlRpcValue& value = *set;
    order.place = {static_cast<int>(value[kNumber]), static_cast<int>(value[kCount])};
    order.name = static_cast<std::string>(value[kName]);
    order.method = static_cast<std::string>(value[kMethod]);
    order.out = static_cast<std::string>(value[kOut]);
  } catch (const XmlRpc::XmlRpcException&) {
    order.place.number = 0;
  }
  const BatchPlace& place = order.place;
  if (place.number < 1 || place.number > place.count || place.count > kMostInBatch)
    throw InvalidInput(name, place.text(), "the order that utm_node sets");
  return order;
}

}  // namespace knot_utm
