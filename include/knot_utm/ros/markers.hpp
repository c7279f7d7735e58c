#pragma once

#include <ros/time.h>
#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "knot_utm/machine/options.hpp"
#include "knot_utm/machine/sample.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/step_readings.hpp"

namespace knot_utm {

/// What the colours of the rod show. Of tension: blue in compression, light grey where there is none, yellow to red.
/// Of curvature: light grey where it is straight, yellow to red.
enum class ColorBy { kTension, kCurvature };

/// Tension at the nodes, the mean of their edges' [N].
Eigen::VectorXd tension_at_nodes(const Eigen::VectorXd& tension);

/// Curvature at the nodes, of the circle whose tangents its two edges are in their middles, times the radius of the
/// rod: the strain that bending gives its surface. Zero at both ends. [-]
Eigen::VectorXd curvature_at_nodes(const Points& points, double radius);

/// Surface of a tube around a centreline: a TRIANGLE_LIST with outward winding and flat ends, lit by its colours.
/// The cross-section is carried along without twist, so that the surface does not wring where the rod turns.
struct TubeOptions {
  int sides = 16;
  double highest = 1.0;      ///< value where the colours end; the others end at its negative
  Eigen::Index parted = -1;  ///< edge that is not there; -1: all are
};
/// `value`: of each node, what the colours show; none: grey.
visualization_msgs::Marker tube_marker(const Points& points, const Eigen::VectorXd& value, double radius,
                                       const TubeOptions& options);

/// One line for every force, its middle where the strands meet and each half as long as the force: they stick out of
/// the strands where these are pressed. `longest`: half of the line of `highest` [m].
visualization_msgs::Marker contact_marker(const std::vector<ContactForce>& forces, double radius, double highest,
                                          double longest);

/// What a picture of the test is made of.
struct SceneView {
  const Points& points;                       ///< nodes of the rod [m]
  const Eigen::VectorXd& tension;             ///< of each edge [N]
  const std::vector<ContactForce>& contacts;  ///< between the strands
  Vec3 lower_grip;                            ///< [m]
  Vec3 upper_grip;                            ///< [m]
  const Sample& sample;
  std::string motion_pattern;
};

/// The pictures of one test after the other, whose colours and lengths mean the same throughout a phase: they end at
/// the largest value seen in it so far. Tying and locking pull harder by orders of magnitude than what comes between.
class ScenePicture {
 public:
  ScenePicture(const MachineOptions& machine, double radius) : machine_(machine), radius_(radius) {}

  void begin(const Points& points);  ///< a new specimen, which gets its gauge marks now
  void color_by(ColorBy what) { color_by_ = what; }
  void show_contacts(bool shown) { show_contacts_ = shown; }

  /// The rod with its gauge marks, the forces between its strands, both grips (rollers as cylinders along y, else
  /// blocks), and as text the phase, the load cell's reading, extension, knot distance, motion pattern, and where the
  /// colours end.
  visualization_msgs::MarkerArray draw(const SceneView& view, const ros::Time& stamp);

 private:
  Eigen::Index parted_edge(const Sample& sample) const;
  void forget_largest() { highest_tension_ = highest_curvature_ = highest_contact_ = 0.0; }
  visualization_msgs::Marker rod_marker(const SceneView& view);
  visualization_msgs::Marker text_marker(const SceneView& view) const;

  MachineOptions machine_;
  double radius_;                    ///< of the rod [m]
  Eigen::VectorXd arclength_;        ///< of the nodes, as the specimen began [m]
  std::vector<Eigen::Index> gauge_;  ///< nodes with a mark
  ColorBy color_by_ = ColorBy::kTension;
  bool show_contacts_ = true;
  Phase phase_ = Phase::kIdle;
  double highest_tension_ = 0.0;    ///< [N]
  double highest_curvature_ = 0.0;  ///< [-]
  double highest_contact_ = 0.0;    ///< [N]
};

}  // namespace knot_utm
