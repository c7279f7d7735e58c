#pragma once

#include <ros/time.h>
#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "knot_utm/machine/grip_bodies.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/ros/color_scale.hpp"
#include "knot_utm/sim/contact_force.hpp"

namespace knot_utm {

/// Tension at the nodes, the mean of their edges' [N].
Eigen::VectorXd tension_at_nodes(const Eigen::VectorXd& tension);

/// Curvature at the nodes, of the circle whose tangents its two edges are in their middles, times the radius of the
/// rod: the strain that bending gives its surface. Zero at both ends. [-]
Eigen::VectorXd curvature_at_nodes(const Points& points, double radius);

using Colors = std::vector<std_msgs::ColorRGBA>;

/// Surface of a tube around a centreline: a TRIANGLE_LIST with outward winding and flat ends, lit by its colours.
/// The cross-section is carried along without twist, so that the surface does not wring where the rod turns.
struct TubeOptions {
  int sides = 12;
  Eigen::Index parted = -1;  ///< edge that is not there; -1: all are
};
/// `colors`: one for each node.
visualization_msgs::Marker tube_marker(const Points& points, const Colors& colors, double radius,
                                       const TubeOptions& options);

/// The same as a row of spheres, a SPHERE_LIST: a fiftieth of the bytes. Where edges are long there are spheres between
/// the nodes, too.
visualization_msgs::Marker spheres_marker(const Points& points, const Colors& colors, double radius,
                                          Eigen::Index parted);

/// One line for every force, its middle where the strands meet: they stick out of the strands where these are pressed.
/// Half of a line is as long as the force's place on the scale of tension says. `longest`: where that is 1 [m].
visualization_msgs::Marker contact_marker(const std::vector<ContactForce>& forces, double radius,
                                          const ColorScale& scale, double longest);

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

/// The pictures of one test after the other.
class ScenePicture {
 public:
  ScenePicture(const SpecimenOptions& specimen, const MachineOptions& machine, const Material& material);

  void begin(const Points& points);  ///< a new specimen, which gets its gauge marks now
  void color_by(ColorBy what) { color_by_ = what; }
  void show_contacts(bool shown) { show_contacts_ = shown; }

  /// What the colours of the rod mean now.
  const ColorScale& scale() const { return color_by_ == ColorBy::kTension ? tension_ : curvature_; }

  /// The rod with its gauge marks, the forces between its strands, and what holds and bears it.
  visualization_msgs::MarkerArray draw(const SceneView& view, const ros::Time& stamp) const;

  /// For a bag, small: the rod as spheres, what holds and bears it, and the readings as text that stands still in the
  /// picture that the camera takes from `eye`, before all else.
  visualization_msgs::MarkerArray draw_small(const SceneView& view, const Vec3& eye, const ros::Time& stamp) const;

 private:
  Eigen::Index parted_edge(const Sample& sample) const;
  Colors colors(const SceneView& view, Eigen::Index parted) const;
  visualization_msgs::Marker rod_marker(const SceneView& view) const;
  void add_bodies(const SceneView& view, std::vector<visualization_msgs::Marker>& markers) const;
  visualization_msgs::Marker reading_marker(const SceneView& view, const Vec3& eye) const;

  std::vector<GripBody> bodies_;
  double radius_;                    ///< of the rod [m]
  Eigen::VectorXd arclength_;        ///< of the nodes, as the specimen began [m]
  std::vector<Eigen::Index> gauge_;  ///< nodes with a mark
  ColorBy color_by_ = ColorBy::kTension;
  ColorScale tension_, curvature_;
  bool show_contacts_ = true;
};

}  // namespace knot_utm
