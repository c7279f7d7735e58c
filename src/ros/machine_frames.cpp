#include "knot_utm/ros/machine_frames.hpp"

#include "knot_utm/ros/names.hpp"

namespace knot_utm {
namespace {

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

Transforms MachineFrames::fixed(const ros::Time& stamp) const {
  return {transform(names::kWorldFrame, names::kBaseFrame, Vec3::Zero(), stamp),
          transform(names::kBaseFrame, names::kLowerGripFrame, lower_grip_, stamp),
          transform(names::kUpperGripFrame, names::kLoadCellFrame, Vec3::Zero(), stamp)};
}

Transforms MachineFrames::moving(const ros::Time& stamp, double displacement, const Vec3& upper_grip) const {
  const Vec3 crosshead = lower_grip_ + Vec3(0.0, 0.0, end_to_end_ + displacement);
  return {transform(names::kBaseFrame, names::kCrossheadFrame, crosshead, stamp),
          transform(names::kCrossheadFrame, names::kUpperGripFrame, upper_grip - crosshead, stamp)};
}

}  // namespace knot_utm
