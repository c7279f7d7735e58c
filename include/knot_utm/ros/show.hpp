#pragma once

#include <dynamic_reconfigure/server.h>
#include <knot_utm/ViewConfig.h>
#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <functional>
#include <optional>
#include <vector>

#include "knot_utm/method/method.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/ros/machine_frames.hpp"
#include "knot_utm/ros/markers.hpp"
#include "knot_utm/ros/shown_state.hpp"
#include "knot_utm/ros/views.hpp"

namespace knot_utm {

/// What a node shows of a test: the frames on /tf and /tf_static, the pictures for rviz, and the meaning of their
/// colours. A picture is drawn at ~marker_rate, while somebody subscribes. Whoever subscribes late gets the last moving
/// frames: before a test and after it nothing moves, and no others come.
///
/// The parameters ~marker_rate, ~color_by and ~contact_forces can be changed by dynamic_reconfigure while the node
/// runs. Where a value is not allowed all of them stay as they were, which the client is told, and a line says what is
/// allowed.
class Show {
 public:
  /// `latest`: the state to be shown; without points there is none yet. `forces`: between its strands. Throws
  /// InvalidInput where a parameter has a value that is not allowed.
  Show(ros::NodeHandle node, std::function<Moment()> latest, std::function<std::vector<ContactForce>()> forces);

  /// Begins a new specimen, with its nodes at these places and these edges between its ropes, on a machine with its
  /// lower grip at this place.
  void begin(const Method& method, const Vec3& lower_grip, const Points& points, const std::vector<int>& cuts);

  void state_changed();  ///< to be called when there is another latest state
  void settle();         ///< shows the latest state now: the node may end before the pictures have come to it
  bool somebody_looks() const { return markers_.getNumSubscribers() > 0; }

 private:
  void take(ViewConfig& wanted);
  void apply();  ///< the parameters to the picture
  void on_timer();
  void draw();
  void publish_frames(const Moment& moment, const Looks* looks);

  std::function<Moment()> latest_;
  std::function<std::vector<ContactForce>()> forces_;
  std::optional<ViewConfig> view_;
  Vec3 lower_grip_ = Vec3::Zero();
  std::optional<MachineFrames> frames_;  ///< empty, as the next two: before the first specimen
  std::optional<ScenePicture> picture_;
  std::optional<Views> views_;
  ShownState shown_;  ///< maintained while somebody views the pictures
  bool is_old_ = true;
  std::uint32_t viewers_ = 0;
  ros::Time published_;  ///< stamp of the last moving frames

  ros::Publisher markers_, colors_;
  ros::Publisher moving_;  ///< latched
  ros::Publisher looks_;
  tf2_ros::StaticTransformBroadcaster fixed_;
  ros::SteadyTimer timer_;
  dynamic_reconfigure::Server<ViewConfig> server_;
};

}  // namespace knot_utm
