#pragma once

#include <dynamic_reconfigure/server.h>
#include <knot_utm/ViewConfig.h>
#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <functional>
#include <optional>
#include <vector>

#include "knot_utm/method/method.hpp"
#include "knot_utm/ros/markers.hpp"

namespace knot_utm {

/// What a node shows of a test: the frames on /tf and /tf_static, the pictures for rviz, and the meaning of their
/// colours. Pictures show the latest state, at most ~marker_rate of them, while somebody subscribes. Whoever subscribes
/// late gets the last moving frames: before a test and after it nothing moves, and no others come.
///
/// The parameters ~marker_rate, ~color_by and ~contact_forces can be changed by dynamic_reconfigure while the node
/// runs. Where a value is not allowed all of them stay as they were, which the client is told, and a line says what is
/// allowed.
class Show {
 public:
  /// `latest`: the state to be shown. Throws InvalidInput where a parameter has a value that is not allowed.
  Show(ros::NodeHandle node, std::function<SceneView()> latest);

  /// Begins a new specimen, with its nodes at these places and these edges between its ropes, on a machine with its
  /// lower grip at this place.
  void begin(const Method& method, const Vec3& lower_grip, const Points& points, const std::vector<int>& cuts);

  void state_changed() { is_old_ = true; }  ///< to be called when there is another latest state
  void show_latest();                       ///< now, for the node may end before the next picture

 private:
  void take(ViewConfig& wanted);
  void apply();  ///< the parameters to the picture
  void publish_frames(const SceneView& view);

  std::function<SceneView()> latest_;
  std::optional<ViewConfig> view_;
  Vec3 crosshead_ = Vec3::Zero();        ///< at the beginning of the test [m]
  std::optional<ScenePicture> picture_;  ///< empty: before the first specimen
  bool is_old_ = true;
  std::uint32_t viewers_ = 0;
  ros::Time published_;  ///< stamp of the last moving frames

  ros::Publisher markers_, colors_;
  ros::Publisher moving_;  ///< latched
  tf2_ros::StaticTransformBroadcaster fixed_;
  ros::SteadyTimer timer_;
  dynamic_reconfigure::Server<ViewConfig> server_;
};

}  // namespace knot_utm
