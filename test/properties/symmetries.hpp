#pragma once

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/rod.hpp"
#include "properties/scene.hpp"

namespace knot_utm::properties {

/// x -> turn x + shift. `turn` is orthogonal; where its determinant is -1 it mirrors, and angles change their sign.
struct Motion {
  Mat3 turn = Mat3::Identity();
  Vec3 shift = Vec3::Zero();

  Points of(const Points& points) const { return (turn * points).colwise() + shift; }
  double handedness() const { return turn.determinant() < 0.0 ? -1.0 : 1.0; }
};

inline Scene moved(Scene scene, const Motion& motion) {
  scene.state.position = motion.of(scene.state.position);
  scene.state.velocity = motion.turn * scene.state.velocity;
  scene.settings.gravity = motion.turn * scene.settings.gravity;
  for (Boundary& boundary : scene.boundary) {
    for (Roller& roller : boundary.rollers) {
      roller.centre = motion.turn * roller.centre + motion.shift;
      roller.axis = motion.turn * roller.axis;
    }
    for (FixedNode& fixed : boundary.fixed_nodes) fixed.position = motion.turn * fixed.position + motion.shift;
    for (FixedTwist& fixed : boundary.fixed_twists) fixed.angle *= motion.handedness();
    for (NodeForce& force : boundary.forces) force.force = motion.turn * force.force;
    for (SlippingGrip& grip : boundary.grips) {
      grip.direction = motion.turn * grip.direction;
      grip.place += grip.direction.dot(motion.shift);
    }
  }
  return scene;
}

/// The same rod with its nodes counted from the other end.
inline Scene reversed(Scene scene) {
  const int last = static_cast<int>(scene.rod.nodes()) - 1;
  scene.rod = make_rod(scene.rod.material, scene.rod.rest_length.reverse());
  scene.state.position = scene.state.position.rowwise().reverse().eval();
  scene.state.velocity = scene.state.velocity.rowwise().reverse().eval();
  for (Boundary& boundary : scene.boundary) {
    for (FixedNode& fixed : boundary.fixed_nodes) fixed.node = last - fixed.node;
    // Tangents turn around, and angles are counted about them.
    for (FixedTwist& fixed : boundary.fixed_twists) fixed = {last - 1 - fixed.edge, -fixed.angle};
    for (NodeForce& force : boundary.forces) force.node = last - force.node;
    for (SlippingGrip& grip : boundary.grips) grip.node = last - grip.node;
  }
  return scene;
}

/// New units: a length of 1 becomes `length`, a force `force`, a time `time`.
struct Units {
  double length, force, time;

  double mass() const { return force * time * time / length; }
  double stress() const { return force / (length * length); }
  double energy() const { return force * length; }
  double speed() const { return length / time; }
};

inline Friction scaled(const Friction& friction, const Units& units) {
  return friction.visit([&](auto law) {
    if constexpr (std::is_same_v<decltype(law), MemoryFriction>) law.presliding *= units.length;
    if constexpr (std::is_same_v<decltype(law), SmoothedFriction>) law.slip_tolerance *= units.speed();
    return Friction(law);
  });
}

inline Scene scaled(Scene scene, const Units& units) {
  RodMaterial material = scene.rod.material;
  material.radius *= units.length;
  material.density *= units.mass() / (units.length * units.length * units.length);
  material.stretching_stiffness *= units.force;
  material.bending_stiffness *= units.force * units.length * units.length;
  material.twisting_stiffness *= units.force * units.length * units.length;
  scene.rod = make_rod(material, units.length * scene.rod.rest_length);
  scene.state.position *= units.length;
  scene.state.velocity *= units.speed();
  scene.dt *= units.time;
  StepSettings& settings = scene.settings;
  auto& normal = settings.pressure_law;
  normal.stiffness *= units.stress();
  normal.tolerance *= units.length;
  normal.stiffening *= units.length;
  settings.friction = scaled(settings.friction, units);
  settings.roller_friction = scaled(settings.roller_friction, units);
  settings.weighting_time *= units.time;
  settings.gravity *= units.speed() / units.time;
  settings.drag *= units.stress() * units.time;
  settings.residual *= units.force;
  settings.residual_from_step *= units.time;
  settings.newton_cap *= units.length;
  settings.motion_limit *= units.length;
  settings.overlap_limit *= units.length;
  settings.candidate_margin *= units.length;
  for (Boundary& boundary : scene.boundary) {
    boundary.extra_drag *= units.stress() * units.time;
    for (Roller& roller : boundary.rollers) {
      roller.centre *= units.length;
      roller.radius *= units.length;
    }
    for (FixedNode& fixed : boundary.fixed_nodes) fixed.position *= units.length;
    for (NodeForce& force : boundary.forces) force.force *= units.force;
    for (SlippingGrip& grip : boundary.grips) {
      grip.place *= units.length;
      grip.stiffness *= units.force / units.length;
      grip.slip_force *= units.force;
    }
  }
  return scene;
}

}  // namespace knot_utm::properties
