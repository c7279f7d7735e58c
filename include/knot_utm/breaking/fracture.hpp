#pragma once

#include <vector>

#include "knot_utm/breaking/breaking_laws.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/stretching.hpp"
#include "knot_utm/sim/contact_force.hpp"
#include "knot_utm/specimen/material.hpp"

namespace knot_utm {

/// How near a rod is to parting, and at which edge. It parts there when the fraction reaches 1.
struct Exposure {
  double fraction = 0.0;  ///< that of the breaking law (tension_breaking.hpp, fibre_breaking.hpp) [-]
  int edge = -1;          ///< where it is largest; -1: nowhere positive, because no edge is under tension or bent
  BreakLimit limit = BreakLimit::kForce;
  double value = 0.0;  ///< the quantity that is limited: tension [N] or strain of the outermost fibre [-]
};

/// The curvature kappa of an edge is that at its more bent end, there the mean along a diameter of rod:
///
///   kappa = |sum_i phi_i w_i|/(2 h)
///
///   phi_i  the turn at node i, as a vector along its axis [rad]
///   w_i    the share of its Voronoi length that lies within h of the end, along the rod at rest [-]
///
/// A rod bends no sharper than its section is wide. Without the mean, a limp rope would be bent over a length of
/// (k_b/T)^1/2 where a strand presses on it, some hundredths of h at the loads that part it, so that the largest
/// curvature would grow as edges get shorter. Cut edges, and ends of ropes, bear nothing.
///
/// The force that presses it flat is the mean along the same diameter, at its more pressed end. Forces from one side
/// press on all of a section that tension holds against them, and those from two sides press once, not twice:
///
///   p = (sum_i w_i |f|_i + |sum_i w_i f_i|)/(4 h)
///
///   f_i, |f|_i  sum of the normal forces of contacts at node i, and of their sizes (Pressing) [N]
class RopeStrengths {
 public:
  /// By the breaking laws of the materials of its ropes, which say all about those that can part.
  RopeStrengths(const Material& material, const RodProperties& rod);

  /// Whether one of the laws asks for what contacts press with.
  bool crush() const;

  /// `pressing`: of all nodes, where one of the laws asks for it.
  Exposure most_exposed(const RodProperties& rod, const Points& position, const Pressing& pressing = {}) const;

 private:
  struct Ropes {
    BreakingLaws law;
    Eigen::Index begin, end;  // their edges
  };
  std::vector<Ropes> ropes_;
};

/// Whether another strand lies against an edge, nearer than 1.1 (h_a + h_b) to it and further than 5 h along the rod.
bool lies_in_knot(const RodProperties& rod, const Points& position, int edge);

}  // namespace knot_utm
