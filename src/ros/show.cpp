#include "knot_utm/ros/show.hpp"

#include <knot_utm/ColorBar.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <utility>

#include "knot_utm/ros/conversions.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

constexpr char kFrames[] = "/tf";  // where tf2 listens
constexpr std::uint32_t kShownQueue = 100;
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

Show::Show(ros::NodeHandle node, std::function<SceneView()> latest)
    : latest_(std::move(latest)),
      markers_(node.advertise<visualization_msgs::MarkerArray>(names::kMarkers, 1)),
      colors_(node.advertise<ColorBar>(names::kColors, 1, true)),
      moving_(node.advertise<tf2_msgs::TFMessage>(kFrames, kShownQueue, true)),
      timer_(node.createSteadyTimer(ros::WallDuration(1.0), [this](const ros::SteadyTimerEvent&) { show_latest(); })),
      server_(ros::NodeHandle("~")) {
  server_.setCallback([this](ViewConfig& wanted, std::uint32_t) { take(wanted); });
}

void Show::take(ViewConfig& wanted) {
  if (const std::optional<InvalidInput> fault = fault_of(wanted)) {
    if (!view_) throw *fault;
    ROS_WARN("%s: refused: %s", ros::this_node::getName().c_str() + 1, fault->what());
    wanted = *view_;
  }
  view_ = wanted;
  timer_.setPeriod(ros::WallDuration(1.0 / wanted.marker_rate));
  if (picture_) apply();
}

void Show::apply() {
  picture_->color_by(view_->color_by == View_tension ? ColorBy::kTension : ColorBy::kCurvature);
  picture_->show_contacts(view_->contact_forces);
  colors_.publish(picture_->scale().bar());
  is_old_ = true;
}

void Show::begin(const Method& method, const Vec3& lower_grip, const Points& points, const std::vector<int>& cuts) {
  crosshead_ = lower_grip + Vec3(0.0, 0.0, method.specimen.end_to_end);
  fixed_.sendTransform(fixed_frames(lower_grip, ros::TIME_MIN));
  picture_.emplace(method.specimen, method.machine, method.material);
  if (points.cols() > 0) picture_->begin(points, cuts);
  apply();
}

void Show::show_latest() {
  const std::uint32_t viewers = markers_.getNumSubscribers();
  const bool somebody_is_new = viewers > viewers_;
  viewers_ = viewers;
  const SceneView view = latest_();
  publish_frames(view);
  if (viewers == 0 || !(is_old_ || somebody_is_new)) return;
  is_old_ = false;
  markers_.publish(picture_->draw(view));
}

/// The moving frames once for each stamp, because tf2 warns of repeated ones.
void Show::publish_frames(const SceneView& view) {
  const ros::Time valid = std::max(view.stamp, ros::TIME_MIN);
  if (valid <= published_) return;
  published_ = valid;
  tf2_msgs::TFMessage message;
  message.transforms = moving_frames(crosshead_, view.sample.displacement, view.upper_grip, valid);
  moving_.publish(message);
}

}  // namespace knot_utm
