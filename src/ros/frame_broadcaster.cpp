#include "knot_utm/ros/frame_broadcaster.hpp"

#include <algorithm>
#include <cstdint>

namespace knot_utm {
namespace {

constexpr char kFrames[] = "/tf";  // where tf2 listens
constexpr std::uint32_t kQueue = 100;

}  // namespace

FrameBroadcaster::FrameBroadcaster(const Vec3& lower_grip, double end_to_end) : frames_(lower_grip, end_to_end) {
  const ros::SubscriberStatusCallback came = [this](const ros::SingleSubscriberPublisher& subscriber) {
    if (latecomers_.came() && !last_.transforms.empty()) subscriber.publish(last_);
  };
  const ros::SubscriberStatusCallback gone = [this](const ros::SingleSubscriberPublisher&) { latecomers_.gone(); };
  moving_ = ros::NodeHandle().advertise<tf2_msgs::TFMessage>(kFrames, kQueue, came, gone);
  fixed_.sendTransform(frames_.fixed(ros::TIME_MIN));
}

void FrameBroadcaster::begin(const Vec3& lower_grip, double end_to_end) {
  frames_ = MachineFrames(lower_grip, end_to_end);
  fixed_.sendTransform(frames_.fixed(ros::TIME_MIN));
}

void FrameBroadcaster::publish(const ros::Time& stamp, double displacement, const Vec3& upper_grip,
                               const Looks* looks) {
  const ros::Time valid = std::max(stamp, ros::TIME_MIN);
  if (valid <= published_ && looks == nullptr) return;
  tf2_msgs::TFMessage message;
  if (valid > published_) {
    message.transforms = frames_.moving(valid, displacement, upper_grip);
    last_ = message;
    latecomers_.published(static_cast<int>(moving_.getNumSubscribers()));
  }
  published_ = std::max(valid, published_);
  if (looks != nullptr) {
    for (const geometry_msgs::TransformStamped& look : MachineFrames::of_looks(published_, *looks))
      message.transforms.push_back(look);
  }
  moving_.publish(message);
}

}  // namespace knot_utm
