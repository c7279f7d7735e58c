#pragma once

#include "knot_utm/sim/options.hpp"

namespace knot_utm {

struct Material;
struct RodMaterial;

/// Radius of the source paper's rods [m]. All default lengths are given for this radius and scale with that of the rod.
constexpr double kPaperRadius = 0.003175;
/// Default lengths of edges for that radius, in knots and elsewhere [m].
constexpr double kPaperKnottedEdge = 0.0032, kPaperEdge = 0.005;

/// Units in which similar specimens of any size and stiffness make similar tests: length h, the radius of the rod;
/// force F_0 = k_b/h^2; time 1 s, as all default speeds are a fixed number of radii a second. Similar specimens differ
/// only in inertia, by the bending time tau = h^2 sqrt(m/k_b), m being the mass per length: 8e-9 s (a stiff thread) to
/// 8 s (a soft hawser). See doc/model.md, section 3, "Mass and drag".
struct SpecimenScales {
  double force = 0.0;       ///< F_0 [N]
  double own_time = 0.0;    ///< tau with the mass of the material [s]
  double mass = 0.0;        ///< m, mass per length from the material's density [kg/m]
  double rest_speed = 0.0;  ///< a specimen is at rest if all nodes are slower than this [m/s]
};
SpecimenScales specimen_scales(const RodMaterial& material);

/// Accelerated mass over the rod's own (`physics.inertia`) [-]. `auto` is the mass of tau = 2e-4 s, about that of the
/// paper's ropes, so that similar specimens move alike, from a thread to a hawser. A rod with a slack loop gets no more
/// than its own mass, and so little that the loop comes to rest: `slack` [m], the length of rod beyond the distance of
/// its ends, makes a loop of radius R = slack/2 pi, which springs in the time R^2 sqrt(m/k_b), at most 0.1 s. The
/// weight always follows from the rod's own mass.
double inertia_factor(const RodMaterial& material, const PhysicsOptions& physics, double slack);
/// Of two materials the smaller one, so that gravity accelerates both ropes alike.
double inertia_factor(const Material& material, const PhysicsOptions& physics, double slack);

/// The material with its densities multiplied by inertia_factor(): that of the mass which is accelerated.
Material with_scaled_inertia(Material material, const PhysicsOptions& physics, double slack);

/// Drag per length of `physics.drag: auto` [N s/m^2]: motion of the whole specimen decays to 1/e in a third of a
/// second. c = 3/s m, which is 1.2e-7 s k_b/h^4 for every rod with tau = 2e-4 s. Nothing else stops a loop that coasts
/// around rollers without friction, however light it is, so its drag is at least that of tau = 2e-5 s. `material`: with
/// scaled inertia.
double drag_to_rest(const RodMaterial& material, bool loop);

/// Drag per length with which bends of wavelength `wave` [m] relax in about a tenth of `time` [s]; [N s/m^2].
double settling_drag(const RodMaterial& material, double wave, double time);

}  // namespace knot_utm
