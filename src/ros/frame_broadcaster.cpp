#include "knot_utm/ros/frame_broadcaster.hpp"

#include <algorithm>
#include <cstdint>

namespace knot_utm {
namespace {

constexpr char kFrames[] = "/tf";  // where tf2 listens
constexpr std::uint32_t kQueue = 100;

}  // namespace

FrameBroadcaster::FrameBroadcaster(const Vec3& lower_grip, double end_to_end) : frames_(lower_grip, end_to_end) {
  moving_ = ros::NodeHandle().advertise<tf2_msgs::TFMessage>(kFrames, kQueue, true);
  looks_ = ros::NodeHandle().advertise<tf2_msgs::TFMessage>(kFrames, kQueue);
  fixed_.sendTransform(frames_.fixed(ros::TIME_MIN));
}

void FrameBroadcaster::begin(const Vec3& lower_grip, double end_to_end) {
  frames_ = MachineFrames(lower_grip, end_to_end);
  fixed_.sendTransform(frames_.fixed(ros::TIME_MIN));
}

void FrameBroadcaster::publish(const ros::Time& stamp, double displacement, const Vec3& upper_grip,
                               const Looks* looks) {
  const ros::Time valid = std::max(stamp, ros::TIME_MIN);
  tf2_msgs::TFMessage message;
  if (valid > published_) {
    published_ = valid;
    message.transforms = frames_.moving(valid, displacement, upper_grip);
    moving_.publish(message);
  }
  if (looks == nullptr) return;
  message.transforms = MachineFrames::of_looks(published_, *looks);
  looks_.publish(message);
}

}  // namespace knot_utm
