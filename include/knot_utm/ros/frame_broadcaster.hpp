#pragma once

#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/ros/latecomers.hpp"
#include "knot_utm/ros/machine_frames.hpp"

namespace knot_utm {

/// Publishes the frames of a test on /tf and /tf_static. Whoever subscribes late gets the last moving frames: before a
/// test and after it nothing moves, and no others come.
class FrameBroadcaster {
 public:
  FrameBroadcaster(const Vec3& lower_grip, double end_to_end);
  ~FrameBroadcaster() = default;
  FrameBroadcaster(const FrameBroadcaster&) = delete;
  FrameBroadcaster& operator=(const FrameBroadcaster&) = delete;
  FrameBroadcaster(FrameBroadcaster&&) = delete;
  FrameBroadcaster& operator=(FrameBroadcaster&&) = delete;

  /// Begins a new specimen, whose grips may have other places.
  void begin(const Vec3& lower_grip, double end_to_end);

  /// Publishes the moving frames, once for each stamp, because tf2 warns of repeated ones. `looks`: the camera
  /// positions; null where nobody views them.
  void publish(const ros::Time& stamp, double displacement, const Vec3& upper_grip, const Looks* looks);

 private:
  MachineFrames frames_;
  ros::Time published_;
  tf2_msgs::TFMessage last_;  ///< the moving frames at that time
  Latecomers latecomers_;
  ros::Publisher moving_;
  tf2_ros::StaticTransformBroadcaster fixed_;
};

}  // namespace knot_utm
