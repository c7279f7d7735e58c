#include "knot_utm/ros/frame_broadcaster.hpp"

#include <algorithm>

namespace knot_utm {

FrameBroadcaster::FrameBroadcaster(const Vec3& lower_grip, double end_to_end) : frames_(lower_grip, end_to_end) {
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
  Transforms transforms;
  if (valid > published_) transforms = frames_.moving(valid, displacement, upper_grip);
  published_ = std::max(valid, published_);
  if (looks != nullptr) {
    for (const geometry_msgs::TransformStamped& look : MachineFrames::of_looks(published_, *looks))
      transforms.push_back(look);
  }
  moving_.sendTransform(transforms);
}

}  // namespace knot_utm
