#pragma once

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/time_step.hpp"
#include "rod/materials.hpp"

namespace knot_utm {

/// Polypropylene on smooth ground: a scene adds the friction it needs.
inline Material braided_rope() {
  Material material = polypropylene();
  material.friction_coefficient = 0.0;
  return material;
}

/// The settings that scenes of closed forms start from.
inline StepSettings closed_form_settings(const RodMaterial& material) {
  const double h = material.radius;
  StepSettings out;
  out.pressure_law = NormalLaw{2.0 * material.stretching_stiffness / (h * h), 0.05 * h};
  out.friction = MemoryFriction{0.0, 1e-3 * h};
  out.roller_friction = out.friction;
  out.residual = 1e-8;
  out.residual_of_tension = 1e-9;
  out.newton_cap = 0.1 * h;
  out.motion_limit = 0.8 * h;
  out.overlap_limit = 0.5 * h;
  out.candidate_margin = 0.5 * h;
  out.max_iterations = 40;
  return out;
}

/// Rod of equal edges along +x with its middle at the origin, at rest.
inline RodState straight_state(const RodProperties& rod) {
  RodState state;
  state.position = Points::Zero(3, rod.nodes());
  state.position.row(0).setLinSpaced(rod.nodes(), -0.5 * rod.length(), 0.5 * rod.length());
  state.velocity = Points::Zero(3, rod.nodes());
  return state;
}

/// The plane z = 0 below a rod along x: a cylinder along x whose radius is 1e4 lengths of the rod.
inline Roller plane_below(double rod_radius) {
  Roller out;
  out.radius = 1000.0;
  out.axis = Vec3::UnitX();
  out.centre = Vec3(0.0, 0.0, -out.radius - rod_radius);
  return out;
}

}  // namespace knot_utm
