#include "knot_utm/ros/order_of_test.hpp"

#include <optional>

#include "knot_utm/ros/master_parameters.hpp"
#include "knot_utm/ros/names.hpp"

namespace knot_utm {
namespace {

using XmlRpc::XmlRpcValue;

constexpr char kNumber[] = "number", kCount[] = "count", kName[] = "name", kMethod[] = "method", kOut[] = "out";

/// One that is not there, or of another type, is 0 or empty, which no order of utm_node has.
int number_of(XmlRpcValue& order, const char* key) {
  const bool there = order.hasMember(key) && order[key].getType() == XmlRpcValue::TypeInt;
  return there ? static_cast<int>(order[key]) : 0;
}
std::string text_of(XmlRpcValue& order, const char* key) {
  const bool there = order.hasMember(key) && order[key].getType() == XmlRpcValue::TypeString;
  return there ? static_cast<std::string>(order[key]) : "";
}

}  // namespace

TestOrder order_of(const Method& method, const std::string& out, const BatchPlace& place) {
  return {place, method.name, method_yaml(method_of_batch(method, place.count)), out};
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
  const TestOrder order{{number_of(*set, kNumber), number_of(*set, kCount)},
                        text_of(*set, kName),
                        text_of(*set, kMethod),
                        text_of(*set, kOut)};
  const BatchPlace& place = order.place;
  const bool is_one = place.number >= 1 && place.number <= place.count && place.count <= kMostInBatch;
  if (!is_one || order.name.empty() || order.method.empty() || order.out.empty())
    throw InvalidInput(name, place.text(), "the order that utm_node sets");
  return order;
}

}  // namespace knot_utm
