#include "knot_utm/ros/show.hpp"

#include <knot_utm/ColorBar.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <utility>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/numeric/number.hpp"
#include "knot_utm/ros/names.hpp"

namespace knot_utm {
namespace {

using Clock = ShownState::Clock;

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

/// The forces where the strands are shown, each going with the node that it is nearest to.
std::vector<ContactForce> moved(std::vector<ContactForce> forces, const Points& from, const Points& to) {
  for (ContactForce& contact : forces) {
    Eigen::Index node = 0;
    (from.colwise() - contact.place).colwise().squaredNorm().minCoeff(&node);
    contact.place += to.col(node) - from.col(node);
  }
  return forces;
}

}  // namespace

Show::Show(ros::NodeHandle node, std::function<Moment()> latest, std::function<std::vector<ContactForce>()> forces)
    : latest_(std::move(latest)),
      forces_(std::move(forces)),
      markers_(node.advertise<visualization_msgs::MarkerArray>(names::kMarkers, 1)),
      colors_(node.advertise<ColorBar>(names::kColors, 1, true)),
      moving_(node.advertise<tf2_msgs::TFMessage>(kFrames, kShownQueue, true)),
      looks_(node.advertise<tf2_msgs::TFMessage>(kFrames, kShownQueue)),
      timer_(node.createSteadyTimer(ros::WallDuration(1.0), [this](const ros::SteadyTimerEvent&) { on_timer(); })),
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
  lower_grip_ = lower_grip;
  frames_.emplace(lower_grip, method.specimen.end_to_end);
  fixed_.sendTransform(frames_->fixed(ros::TIME_MIN));
  picture_.emplace(method.specimen, method.machine, method.material);
  if (points.cols() > 0) picture_->begin(points, cuts);
  views_.emplace(method.specimen, method.machine, method.material, cuts);
  shown_.begin();
  apply();
}

void Show::state_changed() {
  is_old_ = true;
  if (viewers_ > 0) shown_.add(latest_(), Clock::now());
}

void Show::settle() {
  shown_.settle();
  on_timer();
}

void Show::on_timer() {
  const std::uint32_t viewers = markers_.getNumSubscribers();
  const bool somebody_is_new = viewers > viewers_;
  if (viewers_ == 0) shown_.begin();
  viewers_ = viewers;
  const Moment latest = latest_();
  if (latest.points.cols() == 0) return;
  if (viewers == 0) return publish_frames(latest, nullptr);
  if (shown_.empty()) shown_.add(latest, Clock::now());
  if (is_old_ || somebody_is_new) draw();
}

void Show::draw() {
  const Clock::time_point now = Clock::now();
  is_old_ = !shown_.settled(now);
  const Moment moment = shown_.at(now);
  const Looks looks = views_->look(moment.points, lower_grip_, moment.upper_grip, moment.sample);
  publish_frames(moment, &looks);
  const std::vector<ContactForce> contacts = moved(forces_(), shown_.latest().points, moment.points);
  const SceneView view{moment.points, moment.tension,       contacts, lower_grip_, moment.upper_grip,
                       moment.sample, moment.motion_pattern};
  markers_.publish(picture_->draw(view, moment.stamp));
}

/// The moving frames once for each stamp, because tf2 warns of repeated ones.
void Show::publish_frames(const Moment& moment, const Looks* looks) {
  const ros::Time valid = std::max(moment.stamp, ros::TIME_MIN);
  tf2_msgs::TFMessage message;
  if (valid > published_) {
    published_ = valid;
    message.transforms = frames_->moving(valid, moment.sample.displacement, moment.upper_grip);
    moving_.publish(message);
  }
  if (looks == nullptr) return;
  message.transforms = MachineFrames::of_looks(published_, *looks);
  looks_.publish(message);
}

}  // namespace knot_utm
