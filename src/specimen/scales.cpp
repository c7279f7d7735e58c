#include "knot_utm/specimen/scales.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "knot_utm/specimen/material.hpp"

namespace knot_utm {
namespace {

// Between the times of nylon and polypropylene, 2.9e-4 and 1.6e-4 s. Of these, 3e-5 s takes 23 and 35 % more iterations
// and moves the plateaus by +5.5 and -0.1 %, 8e-4 s takes 4 and 17 % fewer and moves them by -3.6 and -0.5 %
// (config/tighten.yaml with physics.inertia 0.0105 and 0.0367, 7.45 and 26.1).
constexpr double kBendingTime = 2e-4;  // tau [s]
// With 3.7 s, that of its own mass, a loose overhand in a rod of 4 m swings through its whole pull, with 0.8 s a tenth
// of it; with 0.1 s its force is steady (doc/developers/measured.md).
constexpr double kSlackTime = 0.1;  // in which a slack loop springs, at most [s]
// The drag of a loop is no less than that of a rod with this time. A thread with tau = 1.9e-7 s, whose drag followed
// from its own mass, coasted around its rollers at 80 m/s, in steps that led nowhere (doc/developers/measured.md).
constexpr double kCoastingTime = 2e-5;  // tau [s]
constexpr double kFading = 3.0;         // of motion under the drag that brings a specimen to rest [1/s]
constexpr double kRestSpeed = 0.0063;   // [radii/s]

/// Mass per length with which a rod that is bent over a length springs back in this time [kg/m]. Without a root, so
/// that similar specimens have the same bits.
double mass_of(double time, double length, const RodMaterial& material) {
  const double length2 = length * length;
  return time * time * material.bending_stiffness / (length2 * length2);
}

}  // namespace

SpecimenScales specimen_scales(const RodMaterial& material) {
  const double h = material.radius;
  SpecimenScales out;
  out.force = material.bending_stiffness / (h * h);
  out.mass = material.density * M_PI * h * h;
  out.own_time = h * h * std::sqrt(out.mass / material.bending_stiffness);
  out.rest_speed = kRestSpeed * h;
  return out;
}

double inertia_factor(const RodMaterial& material, const PhysicsOptions& physics, double slack) {
  const double loop = slack / (2.0 * M_PI), own = specimen_scales(material).mass;
  double mass = mass_of(kBendingTime, material.radius, material);
  if (loop > 0.0) mass = std::min({mass, own, mass_of(kSlackTime, loop, material)});
  return physics.inertia.value_or(mass / own);
}

double inertia_factor(const Material& material, const PhysicsOptions& physics, double slack) {
  const auto of = [&](const RodMaterial& rope) { return inertia_factor(rope, physics, slack); };
  return material.other ? std::min(of(material), of(*material.other)) : of(material);
}

Material with_scaled_inertia(Material material, const PhysicsOptions& physics, double slack) {
  const double factor = inertia_factor(material, physics, slack);
  material.density *= factor;
  if (!material.other) return material;
  Material other = *material.other;
  other.density *= factor;
  material.other = std::make_shared<const Material>(std::move(other));
  return material;
}

double drag_to_rest(const RodMaterial& material, bool loop) {
  const double mass = specimen_scales(material).mass;
  return kFading * (loop ? std::max(mass, mass_of(kCoastingTime, material.radius, material)) : mass);
}

double settling_drag(const RodMaterial& material, double wave, double time) {
  return 0.1 * time * material.bending_stiffness * std::pow(2.0 * M_PI / wave, 4);
}

}  // namespace knot_utm
