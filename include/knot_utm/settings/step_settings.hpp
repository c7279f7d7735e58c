#pragma once

#include "knot_utm/sim/options.hpp"
#include "knot_utm/sim/scene.hpp"
#include "knot_utm/specimen/centreline.hpp"
#include "knot_utm/specimen/machine_options.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

struct Material;

/// The settings of the time steps from the method, in SI units. The drag is not among them, because it changes during a
/// test (TimeStep::set_drag).
StepSettings step_settings(const SpecimenOptions& specimen, const Material& material, const MachineOptions& machine,
                           const PhysicsOptions& physics);

/// 1 where friction acts at the surface, with its couple, else 0 [-]: that of the material, or 0 where a method puts
/// friction on the centreline.
double friction_couple(const Material& material, const PhysicsOptions& physics);

/// The pressure law of contacts between strands of this material, and on rollers, with the contact tolerance delta [m].
NormalLaw normal_law(const Material& material, double tolerance);

/// That of strands of two materials, which give way one behind the other: half of each one's own contact is its, so
/// that 2/K = 1/K_a + 1/K_b.
NormalLaw normal_law_between(const Material& a, const Material& b, double tolerance);

/// Resistance to rolling between strands of two materials. Either half of a contact loses its own share of the work
/// that goes into it, and more work goes into the one that gives way more; the share lost by hysteresis goes alike:
///
///   mu_r = (mu_a K_b + mu_b K_a)/(K_a + K_b)
///
/// The pressed strip is as wide as that of two strands of the radius h with 2/h = 1/h_a + 1/h_b, and of a modulus with
/// 2/E = 1/E_a + 1/E_b (Johnson, Contact Mechanics, 4.2). `presliding`: in that radius [-].
RollingResistance rolling_between(const Material& a, const Material& b, double presliding);

/// Friction coefficient between ropes of two materials (physics.friction.pair) [-].
double pair_friction(const Material& material, const PhysicsOptions& physics);

/// Whether friction turns the rod about itself, so that the scene must solve for twist.
bool friction_rolls(const Material& material, const MachineOptions& machine, const PhysicsOptions& physics);

/// The rod's centreline in the machine before anything moves, with the lower grip at the origin, pulled along +z, and
/// with the edges of the chosen accuracy.
Centreline specimen_centreline(const SpecimenOptions& specimen, const Material& material, const MachineOptions& machine,
                               const PhysicsOptions& physics);

/// Length of rod beyond the distance of its two ends, of a knotted strand that is pulled as it was sketched; 0 of all
/// other specimens [m].
double slack_of(const SpecimenOptions& specimen, const Centreline& centreline);

}  // namespace knot_utm
