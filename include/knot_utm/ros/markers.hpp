#pragma once

#include <ros/time.h>
#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MarkerArray.h>

#include <limits>
#include <vector>

#include "knot_utm/grips/grips.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/ros/color_scale.hpp"
#include "knot_utm/sim/contact_force.hpp"
#include "knot_utm/specimen/material.hpp"

namespace knot_utm {

/// Tension at the nodes: the mean of the tensions of the two edges [N]. `cuts`, here and below: edges between one rope
/// and the next (RodProperties::cuts).
Eigen::VectorXd tension_at_nodes(const Eigen::VectorXd& tension, const std::vector<int>& cuts = {});

/// Radii of ropes that follow each other, of which those behind the first one may be of another material [m].
struct RopeRadii {
  double first, others;
  Eigen::Index first_of_others = std::numeric_limits<Eigen::Index>::max();  ///< node

  RopeRadii(double all) : first(all), others(all) {}
  RopeRadii(const Material& material, const std::vector<int>& cuts);

  double operator()(Eigen::Index node) const { return node < first_of_others ? first : others; }
};

/// Curvature at the nodes times the radius of the rod, which is the bending strain at the rod's surface [-]. The
/// curvature is that of the circle that touches both edges of the node at their midpoints. Zero at the ends of each
/// rope.
Eigen::VectorXd curvature_at_nodes(const Points& points, const RopeRadii& radius, const std::vector<int>& cuts = {});

/// A colour for each node.
using Colors = std::vector<std_msgs::ColorRGBA>;

/// The surface of a tube of `sides` faces around the centreline of each rope: a TRIANGLE_LIST with outward winding,
/// flat ends and a colour for each vertex. The cross-section is carried along the centreline without twist, so that the
/// surface is not wrung where the rod turns. Where it is straight and of one colour its faces are long. `missing`:
/// edges that are not drawn, ascending: cuts, and those at a break.
visualization_msgs::Marker tube_marker(const Points& points, const Colors& colors, const RopeRadii& radius,
                                       const std::vector<int>& missing, int sides);

/// The same as a row of cylinders, which rviz draws round and lights: a tenth of the bytes of six sides.
std::vector<visualization_msgs::Marker> cylinder_markers(const Points& points, const Colors& colors,
                                                         const RopeRadii& radius, const std::vector<int>& missing);

/// One line for each contact force, centred at the contact. The lines stick out of the strands where the strands are
/// pressed together. Half of a line has the length `longest` [m] times the place of the force on the scale of tension.
visualization_msgs::Marker contact_marker(const std::vector<ContactForce>& forces, double radius,
                                          const ColorScale& scale, double longest);

/// Everything from which a picture of the test is drawn.
struct SceneView {
  Points points;                       ///< nodes of the rod [m]
  Eigen::VectorXd tension;             ///< of each edge [N]; of a rod that has parted it is not shown
  std::vector<ContactForce> contacts;  ///< contact forces between the strands
  Vec3 upper_grip;                     ///< [m]
  Sample sample;
  ros::Time stamp;
};

/// Draws pictures of a test, and of the tests that follow it.
class ScenePicture {
 public:
  ScenePicture(const SpecimenOptions& specimen, const MachineOptions& machine, const Material& material);

  /// Begins a new specimen and places its gauge marks.
  void begin(const Points& points, const std::vector<int>& cuts = {});
  void color_by(ColorBy what) { color_by_ = what; }
  void show_contacts(bool shown) { show_contacts_ = shown; }
  void sides(int of_the_tube) { sides_ = of_the_tube; }  ///< 0: the rod is drawn as cylinders

  /// The scale of the rod's colours as they are shown now.
  const ColorScale& scale() const { return color_by_ == ColorBy::kTension ? tension_ : curvature_; }

  /// The rod with its gauge marks, and the forces between its strands.
  visualization_msgs::MarkerArray draw(const SceneView& view) const;

  /// The bodies that hold and support it, in the frames of the grips. They do not change during a test.
  visualization_msgs::MarkerArray bodies() const;

  /// Where the rod is bent most: in its knots, in the middle between them. The middle of a straight rod [m].
  Vec3 knot(const Points& points) const;

 private:
  /// How the rod is drawn.
  struct Rod {
    Colors colors;
    std::vector<int> missing;  ///< edges that are not drawn
  };
  Rod rod_of(const SceneView& view) const;

  std::vector<GripBody> bodies_;
  Material material_;
  RopeRadii radii_;
  std::vector<int> cuts_;
  Eigen::VectorXd arclength_;        ///< of the nodes along all ropes, at the beginning of the specimen [m]
  std::vector<Eigen::Index> gauge_;  ///< nodes that carry a gauge mark
  ColorBy color_by_ = ColorBy::kTension;
  ColorScale tension_, curvature_;
  bool show_contacts_ = true;
  int sides_ = 0;
};

}  // namespace knot_utm
