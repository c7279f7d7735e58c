#pragma once

#include <ros/time.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include "knot_utm/rod/rod.hpp"

namespace knot_utm {

/// The machine's frames: world -> utm_base -> lower_grip, and utm_base -> crosshead -> upper_grip -> load_cell. The
/// crosshead stands `end_to_end` above the lower grip plus its displacement.
class GripFrames {
 public:
  GripFrames(const Vec3& lower_grip, double end_to_end);

  /// Once for each stamp: tf2 warns of one that it has already.
  void publish(const ros::Time& stamp, double displacement, const Vec3& upper_grip);

 private:
  Vec3 lower_grip_;    ///< [m]
  double end_to_end_;  ///< as the test begins [m]
  ros::Time published_;
  tf2_ros::TransformBroadcaster moving_;
  tf2_ros::StaticTransformBroadcaster fixed_;
};

}  // namespace knot_utm
