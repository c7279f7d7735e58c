#include "knot_utm/specimen/scales.hpp"

#include <cmath>

namespace knot_utm {

namespace {

// Where CPU time is least for the paper's materials: 3e-5 s takes 15 to 35 % more iterations and moves the plateau of
// nylon by 5 %, of polypropylene by 0.1 %; 8e-4 s moves them by 4 and 1 % (scripts/bench sizes --set physics.inertia).
constexpr double kBendingTime = 2e-4;  // tau [s]
constexpr double kFading = 3.0;        // of motion under the drag that brings a specimen to rest [1/s]
constexpr double kRestSpeed = 0.0063;  // [radii/s]

}  // namespace

SpecimenScales specimen_scales(const Material& material) {
  const double h = material.radius;
  SpecimenScales out;
  out.length = h;
  out.force = material.bending_stiffness / (h * h);
  out.mass = material.density * M_PI * h * h;
  out.own_time = h * h * std::sqrt(out.mass / material.bending_stiffness);
  out.rest_speed = kRestSpeed * h;
  return out;
}

double inertia_factor(const Material& material, const PhysicsOptions& physics) {
  const double h2 = material.radius * material.radius;  // no root, so that similar specimens have the same bits
  const double mass = kBendingTime * kBendingTime * material.bending_stiffness / (h2 * h2);
  return physics.inertia.value_or(mass / specimen_scales(material).mass);
}

Material as_it_moves(Material material, const PhysicsOptions& physics) {
  material.density *= inertia_factor(material, physics);
  return material;
}

double drag_to_rest(const Material& as_it_moves) { return kFading * specimen_scales(as_it_moves).mass; }

}  // namespace knot_utm
