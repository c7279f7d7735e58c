#pragma once

#include "knot_utm/machine/options.hpp"
#include "knot_utm/sim/options.hpp"
#include "knot_utm/sim/scene.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

struct Material;

/// The settings of the time steps from the method, in SI units. The drag is not among them, because it changes during a
/// test (TimeStep::set_drag).
StepSettings step_settings(const SpecimenOptions& specimen, const Material& material, const MachineOptions& machine,
                           const PhysicsOptions& physics);

/// eta, the fraction of friction's couple that the rod's sections transmit [-]: that of the material, or 0 where a
/// method puts friction on the centreline.
double friction_couple(const Material& material, const PhysicsOptions& physics);

/// The pressure law of contacts between strands of this material, and on rollers, with the contact tolerance delta [m].
NormalLaw normal_law(const Material& material, double tolerance);

/// Whether friction turns the rod about itself, so that the scene must solve for twist.
bool friction_rolls(const Material& material, const MachineOptions& machine, const PhysicsOptions& physics);

}  // namespace knot_utm
