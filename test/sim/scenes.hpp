#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/step_control.hpp"
#include "knot_utm/sim/time_step.hpp"
#include "knot_utm/specimen/overhand.hpp"
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

/// A straight rod of braided rope along x lies on a plane that falls by `angle` towards `down`, and is pressed in by
/// its own weight already, so that nothing falls.
struct OnAnIncline {
  static constexpr double kGravity = 9.81;
  Material material = braided_rope();
  RodProperties rod;
  StepSettings settings;
  RodState state;
  Boundary boundary;
  double normal_force = 0.0;

  OnAnIncline(double angle, const Vec3& down, int edges, const Friction& friction) {
    rod = make_rod(material, Eigen::VectorXd::Constant(edges, material.radius));
    settings = closed_form_settings(material);
    settings.gravity = kGravity * (std::sin(angle) * down - std::cos(angle) * Vec3::UnitZ());
    settings.roller_friction = friction;
    settings.motion_limit = settings.newton_cap = 10.0;
    normal_force = rod.mass.sum() * kGravity * std::cos(angle);
    state = straight_state(rod);
    state.position.row(2).setConstant(-settings.pressure_law.overlap_at(normal_force / rod.length()));
    boundary.rollers = {plane_below(material.radius)};
  }
};

/// Steps from `time` on until a time; `boundary(to)` stands at the end of a step. Throws where the physics gives up.
template <typename BoundaryAt>
void run_to(double until, TimeStep& stepper, double& time, const StepControl::Options& options, BoundaryAt boundary) {
  StepControl control(options);
  const std::string gave_up = control.advance(
      stepper, time, until, [&](double, double to) -> const Boundary& { return boundary(to); },
      [](double, double, const StepSummary&) {});
  if (!gave_up.empty()) throw std::runtime_error(gave_up);
}

/// An overhand in 0.6 m of rod whose ends are 0.35 m apart, as it is drawn, at rest.
struct DrawnOverhand {
  RodProperties rod;
  RodState state;

  explicit DrawnOverhand(const Material& material, double refinement = 1.0) {
    OverhandShape shape;
    shape.radius = material.radius;
    shape.length = 0.6;
    shape.end_to_end = 0.35;
    shape.refinement = refinement;
    state.position = overhand(shape).points;
    const Eigen::Index edges = state.position.cols() - 1;
    rod = make_rod(material, (state.position.rightCols(edges) - state.position.leftCols(edges)).colwise().norm());
    state.velocity = Points::Zero(3, rod.nodes());
  }

  /// Both ends held where they are.
  Boundary held() const {
    Boundary out;
    for (const int node : {0, static_cast<int>(rod.nodes()) - 1})
      out.fixed_nodes.push_back({node, state.position.col(node)});
    return out;
  }
};

/// Settings in which the strands of a knot press on each other as those of a rope do, and slide with its friction.
inline StepSettings sliding_settings(const Material& material) {
  StepSettings out = closed_form_settings(material);
  out.friction = MemoryFriction{material.friction_coefficient, 1e-3 * material.radius};
  out.pressure_law =
      NormalLaw{300.0 * material.bending_stiffness / std::pow(material.radius, 4.0), 0.05 * material.radius};
  out.drag = 1.0;
  out.residual = 1e-4;
  return out;
}

}  // namespace knot_utm
