#pragma once

#include "knot_utm/rod/material.hpp"
#include "knot_utm/sim/options.hpp"

namespace knot_utm {

/// Of the source paper's rods [m]. All default lengths are given for it, and grow with the radius of the rod.
constexpr double kPaperRadius = 0.003175;
/// Of edges for that radius, in knots and elsewhere [m].
constexpr double kPaperKnottedEdge = 0.0032, kPaperEdge = 0.005;

/// The units that a specimen's quantities of test and solver are told in, so that similar specimens of any size and
/// stiffness make similar tests:
///
///   length   h                radius of the rod
///   force    F_0 = k_b/h^2    at which bending gives way to a force on a radius
///   time     1 s              all default speeds are a fixed number of radii a second
///
/// Similar: k_s h^2/k_b, k_t/k_b, mu, K h^4/k_b, F_p/F_0, and all lengths over h are equal. What is left is inertia, by
/// the time tau = h^2 sqrt(m/k_b) in which a wave as long as the rod is thick bends, m the mass per length. A slow test
/// is one that tau has no part in, as long as tau is much shorter than a second and the strands do not jump; where they
/// jump, it decides what they jump to. Rods have tau = 8e-9 (a stiff thread) to 8 s (a soft hawser).
struct SpecimenScales {
  double force = 0.0;       ///< F_0 [N]
  double own_time = 0.0;    ///< tau of the material's mass [s]
  double mass = 0.0;        ///< m of the material's density, per length [kg/m]
  double rest_speed = 0.0;  ///< slower than this it is at rest [m/s]
};
SpecimenScales specimen_scales(const Material& material);

/// Mass that is accelerated, over the rod's own (`physics.inertia`). `auto`: that of tau = 2e-4 s, about that of the
/// paper's ropes, so that similar specimens move alike. Weight is always that of the rod's own mass.
double inertia_factor(const Material& material, const PhysicsOptions& physics);

/// The same material with the density that its mass has where it is accelerated.
Material as_it_moves(Material material, const PhysicsOptions& physics);

/// Drag per length under which a specimen comes to rest where `physics.drag` is `auto` [N s/m^2]: motion of the whole
/// fades to 1/e in a third of a second. c = 3/s m, so with tau = 2e-4 s it is 1.2e-7 s k_b/h^4 in all of them.
double drag_to_rest(const Material& as_it_moves);

/// Drag per length under which waves of the rod so long relax in about a tenth of a time [N s/m^2].
double settling_drag(const Material& material, double wave, double time);

}  // namespace knot_utm
