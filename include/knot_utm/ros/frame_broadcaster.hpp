#pragma once

#include <ros/time.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include "knot_utm/ros/machine_frames.hpp"

namespace knot_utm {

/// Publishes the frames of a test on /tf and /tf_static.
class FrameBroadcaster {
 public:
  FrameBroadcaster(const Vec3& lower_grip, double end_to_end);

  /// Begins a new specimen, whose grips may have other places.
  void begin(const Vec3& lower_grip, double end_to_end);

  /// Publishes the moving frames, once for each stamp, because tf2 warns of repeated ones. `looks`: the camera
  /// positions; null where nobody views them.
  void publish(const ros::Time& stamp, double displacement, const Vec3& upper_grip, const Looks* looks);

 private:
  MachineFrames frames_;
  ros::Time published_;
  tf2_ros::TransformBroadcaster moving_;
  tf2_ros::StaticTransformBroadcaster fixed_;
};

}  // namespace knot_utm
