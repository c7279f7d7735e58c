#include "knot_utm/machine/specimen_centreline.hpp"

#include "knot_utm/machine/accuracy.hpp"
#include "knot_utm/machine/grips.hpp"
#include "knot_utm/specimen/knot.hpp"

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

}  // namespace knot_utm
