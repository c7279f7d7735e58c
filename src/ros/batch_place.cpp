#include "knot_utm/ros/batch_place.hpp"

#include <filesystem>
#include <optional>

#include "knot_utm/io/command_hint.hpp"
#include "knot_utm/ros/master_parameters.hpp"
#include "knot_utm/ros/names.hpp"

namespace knot_utm {
namespace {

constexpr char kNumber[] = "number", kCount[] = "count";

}  // namespace

std::string BatchPlace::text() const { return "specimen " + std::to_string(number) + " of " + std::to_string(count); }

bool set_batch_place(const ros::NodeHandle& node, const BatchPlace& place) {
  XmlRpc::XmlRpcValue value;
  value[kNumber] = place.number;
  value[kCount] = place.count;
  return set_on_master(node.resolveName(names::kBatchPlace), value);
}

BatchPlace batch_place(const ros::NodeHandle& node) {
  const std::string name = node.resolveName(names::kBatchPlace);
  std::optional<XmlRpc::XmlRpcValue> set = get_from_master(name);
  const auto number = [&](const char* key) {
    const bool there = set->hasMember(key) && (*set)[key].getType() == XmlRpc::XmlRpcValue::TypeInt;
    return there ? static_cast<int>((*set)[key]) : 0;
  };
  // Without it nobody knows which specimen is meant: the test is then not taken for one that stands alone.
  if (!set || set->getType() != XmlRpc::XmlRpcValue::TypeStruct)
    throw InvalidInput::sentence(
        name, "",
        "cannot read the parameter " + name +
            ", which utm_node sets before each test: it is not there, or the ROS master does not answer");
  const BatchPlace place{number(kNumber), number(kCount)};
  if (place.number >= 1 && place.number <= place.count && place.count <= kMostInBatch) return place;
  throw InvalidInput(name, place.text(), "the place that utm_node sets");
}

Method method_of_batch(const Method& method, int count) {
  Method out = method;
  out.specimens.count = count;
  return out;
}

std::string command_to_resume(const std::string& batch) {
  const std::string tool = std::filesystem::read_symlink("/proc/self/exe").replace_filename("tensile_test").string();
  return command_line({tool, "--resume", batch});
}

}  // namespace knot_utm
