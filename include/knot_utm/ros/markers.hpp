#pragma once

#include <ros/time.h>
#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "knot_utm/machine/options.hpp"
#include "knot_utm/machine/sample.hpp"
#include "knot_utm/rod/rod.hpp"

namespace knot_utm {

/// Surface of a tube around a centreline: a TRIANGLE_LIST with outward winding and flat ends, lit by its colours.
/// The cross-section is carried along without twist, so that the surface does not wring where the rod turns.
struct TubeOptions {
  int sides = 10;
  double highest_tension = 1.0;  ///< where the colours end [N]; the others end at its negative
};
visualization_msgs::Marker tube_marker(const Points& points, const Eigen::VectorXd& tension, double radius,
                                       const TubeOptions& options);

/// What a scene of the test shows.
struct SceneView {
  const Points& points;            ///< nodes of the rod [m]
  const Eigen::VectorXd& tension;  ///< of each edge [N]
  double radius;                   ///< of the rod [m]
  double highest_tension;          ///< [N], end of the colours
  const MachineOptions& machine;
  Vec3 lower_grip;  ///< [m]
  Vec3 upper_grip;  ///< [m]
  const Sample& sample;
  std::string motion_pattern;
};

/// The rod, both grips (rollers as cylinders along y, else blocks), and as text the phase, the load cell's reading, the
/// extension and the motion pattern.
visualization_msgs::MarkerArray scene_markers(const SceneView& view, const ros::Time& stamp);

}  // namespace knot_utm
