#include "knot_utm/specimen/scales.hpp"

#include <algorithm>
#include <cmath>

namespace knot_utm {

namespace {

// Between the times of nylon and polypropylene, 2.9e-4 and 1.6e-4 s. Of these, 3e-5 s takes 23 and 35 % more iterations
// and moves the plateaus by +5.5 and -0.1 %, 8e-4 s takes 4 and 17 % fewer and moves them by -3.6 and -0.5 %
// (config/tighten.yaml with physics.inertia 0.0105 and 0.0367, 7.45 and 26.1).
constexpr double kBendingTime = 2e-4;  // tau [s]
// With 3.7 s, that of its own mass, a loose overhand in a rod of 4 m swings through its whole pull, with 0.8 s a tenth
// of it; with 0.1 s its force is steady (doc/developers/measured.md).
constexpr double kSlackTime = 0.1;  // of a slack loop [s]
// Loops of a thread with 2e-7 s could not be tied with their own mass: no step was short enough. With 2e-6 s they can.
constexpr double kShortestTime = 2e-6;  // tau of what is tied [s]
constexpr double kFading = 3.0;         // of motion under the drag that brings a specimen to rest [1/s]
constexpr double kRestSpeed = 0.0063;   // [radii/s]

}  // namespace

SpecimenScales specimen_scales(const Material& material) {
  const double h = material.radius;
  SpecimenScales out;
  out.force = material.bending_stiffness / (h * h);
  out.mass = material.density * M_PI * h * h;
  out.own_time = h * h * std::sqrt(out.mass / material.bending_stiffness);
  out.rest_speed = kRestSpeed * h;
  return out;
}

double inertia_factor(const Material& material, const PhysicsOptions& physics, double slack) {
  // No root, so that similar specimens have the same bits.
  const double h2 = material.radius * material.radius, loop = slack / (2.0 * M_PI), loop2 = loop * loop;
  const double own = specimen_scales(material).mass;
  const auto mass_of = [&](double time, double length2) {
    return time * time * material.bending_stiffness / (length2 * length2);
  };
  double mass = mass_of(kBendingTime, h2), most = own;
  if (loop > 0.0)
    mass = std::min(mass, mass_of(kSlackTime, loop2));
  else
    most = std::max(own, mass_of(kShortestTime, h2));
  return physics.inertia.value_or(std::min(mass, most) / own);
}

Material as_it_moves(Material material, const PhysicsOptions& physics, double slack) {
  material.density *= inertia_factor(material, physics, slack);
  return material;
}

double drag_to_rest(const Material& as_it_moves) { return kFading * specimen_scales(as_it_moves).mass; }

double settling_drag(const Material& material, double wave, double time) {
  return 0.1 * time * material.bending_stiffness * std::pow(2.0 * M_PI / wave, 4);
}

}  // namespace knot_utm
