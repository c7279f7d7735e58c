#include "knot_utm/ros/view_parameters.hpp"

#include <ros/console.h>
#include <ros/node_handle.h>
#include <ros/this_node.h>

#include <optional>
#include <utility>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/numeric/number.hpp"

namespace knot_utm {
namespace {

constexpr double kSlowest = 0.1, kFastest = 60.0;  // pictures in a second [Hz]

std::optional<InvalidInput> fault_of(const ViewConfig& wanted) {
  if (!(wanted.marker_rate >= kSlowest && wanted.marker_rate <= kFastest))
    return InvalidInput("marker_rate", format_number(wanted.marker_rate),
                        format_number(kSlowest) + " to " + format_number(kFastest));
  if (wanted.color_by != View_tension && wanted.color_by != View_curvature)
    return InvalidInput("color_by", "\"" + wanted.color_by + "\"", "tension or curvature");
  return std::nullopt;
}

}  // namespace

ViewParameters::ViewParameters(ScenePicture& picture, std::function<void(double)> on_change)
    : picture_(picture), on_change_(std::move(on_change)), server_(ros::NodeHandle("~")) {
  server_.setCallback([this](ViewConfig& wanted, std::uint32_t) { take(wanted); });
}

void ViewParameters::take(ViewConfig& wanted) {
  if (const std::optional<InvalidInput> fault = fault_of(wanted)) {
    if (!now_) throw *fault;
    ROS_WARN("%s: refused: %s", ros::this_node::getName().c_str() + 1, fault->what());
    wanted = *now_;
  }
  now_ = wanted;
  picture_.color_by(wanted.color_by == View_tension ? ColorBy::kTension : ColorBy::kCurvature);
  picture_.show_contacts(wanted.contact_forces);
  on_change_(1.0 / wanted.marker_rate);
}

}  // namespace knot_utm
