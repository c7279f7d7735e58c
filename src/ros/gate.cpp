#include "knot_utm/ros/gate.hpp"

#include <utility>

#include "knot_utm/ros/validate.hpp"

namespace knot_utm {
namespace {

constexpr std::chrono::seconds kQuiet(5);  // after a warning

}  // namespace

void TopicWarning::say(const std::string& publisher, const std::string& fault) {
  const auto now = std::chrono::steady_clock::now();
  if (!silent_so_far_ && now - said_ < kQuiet) return;
  silent_so_far_ = false;
  said_ = now;
  ROS_WARN("a message on %s from %s was ignored: %s", topic_.c_str(), one_line(publisher).c_str(), fault.c_str());
}

Gate::Gate(const std::string& topic, std::string publisher, std::uint32_t largest)
    : publisher_(std::move(publisher)), largest_(largest), warning_(topic) {}

bool Gate::admits(const std::string& publisher, std::uint32_t length) {
  if (publisher != publisher_) {
    warning_.say(publisher, "only " + publisher_ + " may publish there");
    return false;
  }
  if (length > largest_) {
    warning_.say(publisher,
                 "it is " + std::to_string(length) + " bytes long, but may have at most " + std::to_string(largest_));
    return false;
  }
  return true;
}

}  // namespace knot_utm
