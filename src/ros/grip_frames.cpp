#include "knot_utm/ros/grip_frames.hpp"

#include <geometry_msgs/TransformStamped.h>

#include <algorithm>
#include <vector>

#include "knot_utm/ros/names.hpp"

namespace knot_utm {
namespace {

using Transforms = std::vector<geometry_msgs::TransformStamped>;

geometry_msgs::TransformStamped transform(const char* parent, const char* child, const Vec3& translation,
                                          const ros::Time& stamp) {
  geometry_msgs::TransformStamped t;
  t.header.stamp = stamp;
  t.header.frame_id = parent;
  t.child_frame_id = child;
  t.transform.translation.x = translation.x();
  t.transform.translation.y = translation.y();
  t.transform.translation.z = translation.z();
  t.transform.rotation.w = 1.0;
  return t;
}

}  // namespace

GripFrames::GripFrames(const Vec3& lower_grip, double end_to_end) : lower_grip_(lower_grip), end_to_end_(end_to_end) {
  fixed_.sendTransform(
      Transforms{transform(names::kWorldFrame, names::kBaseFrame, Vec3::Zero(), ros::TIME_MIN),
                 transform(names::kBaseFrame, names::kLowerGripFrame, lower_grip_, ros::TIME_MIN),
                 transform(names::kUpperGripFrame, names::kLoadCellFrame, Vec3::Zero(), ros::TIME_MIN)});
}

void GripFrames::publish(const ros::Time& stamp, double displacement, const Vec3& upper_grip) {
  const ros::Time valid = std::max(stamp, ros::TIME_MIN);
  if (valid == published_) return;
  published_ = valid;
  const Vec3 crosshead = lower_grip_ + Vec3(0.0, 0.0, end_to_end_ + displacement);
  moving_.sendTransform(
      Transforms{transform(names::kBaseFrame, names::kCrossheadFrame, crosshead, valid),
                 transform(names::kCrossheadFrame, names::kUpperGripFrame, upper_grip - crosshead, valid)});
}

}  // namespace knot_utm
