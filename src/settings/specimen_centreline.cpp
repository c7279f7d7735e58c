#include "knot_utm/settings/specimen_centreline.hpp"

#include "knot_utm/numeric/pieces.hpp"
#include "knot_utm/settings/accuracy.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/specimen/polyline.hpp"

namespace knot_utm {

Centreline specimen_centreline(const SpecimenOptions& specimen, const Material& material, const MachineOptions& machine,
                               const PhysicsOptions& physics) {
  Mounting mounting;
  mounting.rollers = rollers_hold(specimen, machine);
  mounting.clamps = clamps_hold(specimen, machine);
  mounting.roller_diameter = machine.roller_diameter;
  mounting.refinement = tolerances(physics, specimen, material).refinement;
  return knot_of(specimen).centreline(specimen, material, mounting);
}

double slack_of(const SpecimenOptions& specimen, const Centreline& centreline) {
  const KnotDescription& knot = knot_of(specimen).about();
  if (!knot.may_hold_a_knot() || knot.loop) return 0.0;
  const Points& x = centreline.points;
  const std::vector<double> at = arclengths(x);
  double slack = 0.0;
  for (const Piece& rope : pieces_between(x.cols(), centreline.cuts)) {
    const Eigen::Index last = rope.end - 1;
    slack += at[static_cast<std::size_t>(last)] - at[static_cast<std::size_t>(rope.begin)] -
             (x.col(last) - x.col(rope.begin)).norm();
  }
  return slack;
}

}  // namespace knot_utm
