#include "knot_utm/ros/batch_place.hpp"

#include <ros/master.h>
#include <ros/this_node.h>

#include <map>

#include "knot_utm/ros/names.hpp"

namespace knot_utm {
namespace {

constexpr char kNumber[] = "number", kCount[] = "count";

}  // namespace

std::string BatchPlace::text() const { return "specimen " + std::to_string(number) + " of " + std::to_string(count); }

bool set_batch_place(const ros::NodeHandle& node, const BatchPlace& place) {
  // A master that died is not waited for.
  XmlRpc::XmlRpcValue request, response, payload;
  request[0] = ros::this_node::getName();
  request[1] = node.resolveName(names::kBatchPlace);
  request[2][kNumber] = place.number;
  request[2][kCount] = place.count;
  return ros::master::execute("setParam", request, response, payload, false);
}

BatchPlace batch_place(const ros::NodeHandle& node) {
  std::map<std::string, int> set;
  if (!node.getParam(names::kBatchPlace, set)) return {};
  const BatchPlace place{set[kNumber], set[kCount]};
  if (place.number >= 1 && place.number <= place.count && place.count <= kMostSpecimens) return place;
  throw InvalidInput(node.resolveName(names::kBatchPlace), place.text(), "the place that utm_node sets");
}

Method method_of_batch(const Method& method, int count) {
  Method out = method;
  out.specimens.count = count;
  return out;
}

}  // namespace knot_utm
