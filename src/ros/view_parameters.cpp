#include "knot_utm/ros/view_parameters.hpp"

#include <ros/console.h>
#include <ros/node_handle.h>
#include <ros/this_node.h>

#include <string>
#include <utility>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/numeric/number.hpp"
#include "knot_utm/ros/method_setup.hpp"

namespace knot_utm {
namespace {

constexpr double kSlowest = 0.1, kFastest = 60.0;  // pictures in a second [Hz]
constexpr char kColorings[] = "tension or curvature";

bool is_rate(double rate) { return rate >= kSlowest && rate <= kFastest; }

std::string rates() { return format_number(kSlowest) + " to " + format_number(kFastest); }

void say_refused(const char* name, const std::string& value, const std::string& allowed, const std::string& stays) {
  ROS_WARN("%s: %s: %s is refused: %s is allowed; it stays %s", ros::this_node::getName().c_str() + 1, name,
           shown(value).c_str(), allowed.c_str(), stays.c_str());
}

bool is_coloring(const std::string& word) { return word == View_tension || word == View_curvature; }

/// Before the server takes them, which would change without a word what it cannot use.
ros::NodeHandle with_checked_parameters() {
  const ros::NodeHandle own("~");
  ViewConfig set = ViewConfig::__getDefault__();
  read_parameter(own, "marker_rate", &set.marker_rate, rates().c_str());
  if (!is_rate(set.marker_rate))
    throw InvalidInput(own.resolveName("marker_rate"), format_number(set.marker_rate), rates());
  read_parameter(own, "color_by", &set.color_by, kColorings);
  if (!is_coloring(set.color_by))
    throw InvalidInput(own.resolveName("color_by"), "\"" + set.color_by + "\"", kColorings);
  read_parameter(own, "contact_forces", &set.contact_forces, "true or false");
  return own;
}

}  // namespace

ViewParameters::ViewParameters(ScenePicture& picture, std::function<void(double)> on_change)
    : picture_(picture),
      on_change_(std::move(on_change)),
      now_(ViewConfig::__getDefault__()),
      server_(with_checked_parameters()) {
  server_.setCallback([this](ViewConfig& wanted, std::uint32_t) { take(wanted); });
}

void ViewParameters::take(ViewConfig& wanted) {
  if (!is_rate(wanted.marker_rate)) {
    say_refused("marker_rate", format_number(wanted.marker_rate), rates(), format_number(now_.marker_rate));
    wanted.marker_rate = now_.marker_rate;
  }
  if (!is_coloring(wanted.color_by)) {
    say_refused("color_by", wanted.color_by, kColorings, now_.color_by);
    wanted.color_by = now_.color_by;
  }
  now_ = wanted;
  picture_.color_by(now_.color_by == View_tension ? ColorBy::kTension : ColorBy::kCurvature);
  picture_.show_contacts(now_.contact_forces);
  on_change_(1.0 / now_.marker_rate);
}

}  // namespace knot_utm
