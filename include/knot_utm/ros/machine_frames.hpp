#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>

#include <vector>

#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

using Transforms = std::vector<geometry_msgs::TransformStamped>;

/// The frames of a test: world -> utm_base -> lower_grip, and utm_base -> crosshead -> upper_grip -> load_cell. All
/// have the axes of `world`.
class MachineFrames {
 public:
  /// `end_to_end`: distance between the grips at the beginning of the test [m].
  MachineFrames(const Vec3& lower_grip, double end_to_end) : lower_grip_(lower_grip), end_to_end_(end_to_end) {}

  Transforms fixed(const ros::Time& stamp) const;

  /// The frames that move. The crosshead is above the lower grip by `end_to_end` plus its displacement [m].
  Transforms moving(const ros::Time& stamp, double displacement, const Vec3& upper_grip) const;

 private:
  Vec3 lower_grip_;    ///< [m]
  double end_to_end_;  ///< [m]
};

}  // namespace knot_utm
