// Sections that are flattened and grow thin: forces, stiffnesses and torques against closed forms.

#include "knot_utm/contact/soft_section.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/neo_hookean_stretching.hpp"
#include "knot_utm/rod/thinned.hpp"
#include "knot_utm/sim/time_step.hpp"
#include "reference.hpp"
#include "rod/own_laws.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

constexpr double kRadius = 3e-3;

Material rubber() {
  Material out;
  out.radius = kRadius;
  out.density = 1000.0;
  out.stretching_stiffness = 2.0;
  out.bending_stiffness = 0.25 * out.stretching_stiffness * kRadius * kRadius;
  out.twisting_stiffness = 2.0 / 3.0 * out.bending_stiffness;
  out.section = CrossSection::kSoft;
  return out;
}

/// Two straight strands cross at right angles, pressed together by what they overlap, the first one stretched; all
/// nodes are held. Each strand bears half of the pressure at its own points, over its present length.
TEST(R18SoftSections, TwoCrossedStrandsBearTheIntegralOfTheirPressure) {
  constexpr int kStrand = 120;
  constexpr double kEdge = 0.05 * kRadius, kStretch = 1.6, kHeight = 1.3 * kRadius;
  const Material material = rubber();
  StepSettings settings = closed_form_settings(material);
  settings.pressure_law = NormalLaw{1e5, 1e-3 * kRadius, 0.78 * kRadius};
  settings.friction = MemoryFriction{0.0, kRadius};
  settings.friction_couple = 1.0;
  settings.overlap_limit = 2.0 * kRadius;
  const int nodes = 2 * (kStrand + 1) + 2;
  RodState state;
  state.position.resize(3, nodes);
  for (int i = 0; i <= kStrand; ++i) {
    const double s = kEdge * (i - 0.5 * kStrand);
    state.position.col(i) << s, 0.0, kHeight;
    state.position.col(kStrand + 3 + i) << 0.0, s, 0.0;
  }
  state.position.col(kStrand + 1) << 1.0, 0.0, 1.0;
  state.position.col(kStrand + 2) << 1.0, -1.0, 1.0;
  state.velocity = Points::Zero(3, nodes);
  initialise_frames(&state);
  Eigen::VectorXd rest = (state.position.rightCols(nodes - 1) - state.position.leftCols(nodes - 1)).colwise().norm();
  rest.head(kStrand) /= kStretch;
  Boundary boundary;
  for (int i = 0; i < nodes; ++i) boundary.fixed_nodes.push_back({i, state.position.col(i)});
  const auto stepper = TimeStep::make(make_rod(material, rest), state, settings);
  ASSERT_TRUE(stepper->step(boundary, 1e-3).accepted());
  double force = 0.0;
  for (int i = 0; i <= kStrand; ++i) force += stepper->readings().reaction(i)[2];

  const double radii = kRadius * (1.0 + 1.0 / std::sqrt(kStretch)), scale = 2.0 * kRadius / radii;
  double expected = 0.0;
  const double ds = 1e-4 * kRadius;
  for (double s = 0.5 * ds; s < 2.0 * kRadius; s += ds) {
    const double apart = std::hypot(s, kHeight);
    expected += 2.0 * ds * settings.pressure_law.pressure(scale * (radii - apart)) / scale * kHeight / apart;
  }
  hold_against("R18 crossed strands, one thinner by stretch: force [N]", expected, -force, 0.01);
}

/// A strand of rubber along x is drawn between two fixed cylinders that are nearer than it is thick, at a steady speed.
/// It is flattened by both, and grows longer and thinner within by its tension. With Phi = W(lambda) + lambda E(x,
/// lambda), E the energy of contact per present length, the balance of material forces is
///     d/dx (lambda W' - W + lambda^2 dE/dlambda) = mu p lambda,   p = -2 dE/dD cos(beta) of both cylinders along x.
struct NarrowHole {
  static constexpr int kEdges = 120;
  static constexpr double kEdge = 0.15 * kRadius, kShaft = 8.0 * kRadius, kHalf = 0.55 * kRadius, kSpeed = 1e-3;
  RodProperties rod;
  NormalLaw law;
  double stretch = 1.0, time = 0.0, mu;
  Boundary boundary;
  std::unique_ptr<TimeStep> stepper;

  NarrowHole(double mu_, double load_) : mu(mu_) {
    const Material material = rubber();
    const double load = load_ * material.stretching_stiffness;
    rod = make_rod(material, Eigen::VectorXd::Constant(kEdges, kEdge));
    set_law(rod, StretchingLaws(NeoHookeanStretching()));
    while (respond(rod, 0, {material.stretching_stiffness, 1.0, stretch}).tension < load) stretch += 1e-6;
    RodState state = straight_state(rod);
    state.position *= stretch;
    state.position.row(0).array() -= 4.0 * kRadius;
    initialise_frames(&state);
    StepSettings settings = closed_form_settings(material);
    const double modulus = material.stretching_stiffness / (M_PI * kRadius * kRadius);
    settings.pressure_law = NormalLaw{0.77 * modulus, 1e-3 * kRadius, 0.8 * kRadius};
    law = settings.pressure_law.on_rigid();
    settings.roller_friction = MemoryFriction{mu, 1e-3 * kRadius};
    settings.friction_couple = 1.0;
    settings.overlap_limit = kRadius;
    settings.drag = 1e-3;
    settings.residual = 1e-6;
    stepper = TimeStep::make(rod, state, settings);
    for (const double side : {-1.0, 1.0}) {
      Roller roller;
      roller.axis = Vec3::UnitZ();
      roller.centre = Vec3(0.0, side * (kShaft + kHalf), 0.0);
      roller.radius = kShaft;
      boundary.rollers.push_back(roller);
    }
    boundary.forces = {{0, Vec3(-load, 0.0, 0.0)}};
    boundary.fixed_nodes = {{kEdges, state.position.col(kEdges)}};
  }

  /// Mean force at the end that is pulled, over the way of an edge, once it has moved by `way` [N].
  double pull(double way) {
    constexpr int kReadings = 8;
    const double passed = kEdge * stretch / kReadings;
    move_by(way);
    double sum = 0.0;
    for (int reading = 0; reading < kReadings; ++reading) {
      move_by(passed);
      sum += stepper->readings().reaction(kEdges)[0];
    }
    return sum / kReadings;
  }
  void move_by(double way) {
    StepControl::Options options;
    options.longest = options.first = 0.1 * kEdge / kSpeed;
    options.motion = options.slip = 1e3;
    const Vec3 from = boundary.fixed_nodes[0].position;
    const double begin = time;
    run_to(begin + way / kSpeed, *stepper, time, options, [&](double to) -> const Boundary& {
      boundary.fixed_nodes[0].position = from + Vec3(kSpeed * (to - begin), 0.0, 0.0);
      return boundary;
    });
  }

  double energy(double x, double l) const {
    const double k = std::sqrt(l);
    return 2.0 * law.energy(k * squeezed(x, l)) / (k * k);
  }
  double squeezed(double x, double l) const {
    return kRadius / std::sqrt(l) - (std::hypot(x, kShaft + kHalf) - kShaft);
  }
  /// lambda W' - W + lambda^2 dE/dlambda
  double material_force(double x, double l) const {
    constexpr double kStep = 1e-6;
    const auto own = respond(rod, 0, {rod.material.stretching_stiffness, 1.0, l});
    return l * own.tension - own.energy + l * l * (energy(x, l + kStep) - energy(x, l - kStep)) / (2.0 * kStep);
  }
  double expected() const {
    const double dx = 1e-3 * kRadius;
    double l = stretch, force = material_force(-4.0 * kRadius, l);
    for (double x = -4.0 * kRadius; x < 4.0 * kRadius; x += dx) {
      const double cosine = (kShaft + kHalf) / std::hypot(x, kShaft + kHalf), k = std::sqrt(l);
      force += dx * mu * 2.0 * law.pressure(k * squeezed(x, l)) / k * cosine * l;
      for (int i = 0; i < 3; ++i) {
        const double slope = (material_force(x + dx, l + 1e-5) - material_force(x + dx, l - 1e-5)) / 2e-5;
        l -= (material_force(x + dx, l) - force) / slope;
      }
    }
    return respond(rod, 0, {rod.material.stretching_stiffness, 1.0, l}).tension;
  }
};

TEST(R18SoftSections, AStrandIsDrawnThroughAHoleNarrowerThanIt) {
  for (const double mu : {0.0, 0.3, 0.6}) {
    NarrowHole scene(mu, 0.1);
    hold_against(formatted("R18 strand through a narrower hole, friction %.1f: force [N]", mu), scene.expected(),
                 scene.pull(6.0 * kRadius), 2e-3);
  }
}

/// A rod along x that is stretched by `stretch`, clamped by its first edge, and free to turn elsewhere.
struct Stretched {
  static constexpr int kEdges = 100;
  static constexpr double kEdge = 0.2 * kRadius;
  RodProperties rod;
  Boundary boundary;
  std::unique_ptr<TimeStep> stepper;
  double stretch;

  Stretched(double stretch_, bool rubbery) : stretch(stretch_) {
    const Material material = rubber();
    rod = make_rod(material, Eigen::VectorXd::Constant(kEdges, kEdge));
    if (rubbery) set_law(rod, StretchingLaws(NeoHookeanStretching()));
    RodState state = straight_state(rod);
    state.position *= stretch;
    initialise_frames(&state);
    StepSettings settings = closed_form_settings(material);
    settings.residual = 1e-12;
    settings.drag = 1e-3;
    for (const int node : {0, 1}) boundary.fixed_nodes.push_back({node, state.position.col(node)});
    stepper = TimeStep::make(rod, state, settings);
  }
  double tension() const { return respond(rod, 0, {rod.material.stretching_stiffness, 1.0, stretch}).tension; }
  void settle() {
    for (int i = 0; i < 60; ++i) ASSERT_TRUE(stepper->step(boundary, 10.0).accepted());
  }
};

/// A small load P across the tip of a beam that bears T: its tip moves by P/T (L - tanh(q L)/q), q^2 = T/B, with B =
/// k_b for the linear law, whose section shrinks as its fibres stiffen, and B = k_b W''/k_s of any.
TEST(R18SoftSections, AStretchedCantileverBendsByItsThinnerSection) {
  for (const bool rubbery : {false, true}) {
    Stretched scene(1.5, rubbery);
    const double across = 1e-4 * scene.tension();
    scene.boundary.forces = {{Stretched::kEdges, Vec3(scene.tension(), 0.0, across)}};
    scene.settle();
    const double softer = respond(scene.rod, 0, {1.0, 1.0, scene.stretch}).slope,
                 q = std::sqrt(scene.tension() / (softer * scene.rod.material.bending_stiffness)),
                 length = scene.stretch * Stretched::kEdge * (Stretched::kEdges - 0.5);
    hold_against(
        rubbery ? "R18 stretched cantilever of rubber: deflection [m]" : "R18 stretched cantilever: deflection [m]",
        across / scene.tension() * (length - std::tanh(q * length) / q),
        scene.stepper->state().position(2, Stretched::kEdges), 1e-3);
  }
}

/// Rivlin's torsion of a stretched neo-Hookean cylinder: the torque is k_t/lambda by the twist per length at rest.
TEST(R18SoftSections, AStretchedRodTwistsByItsThinnerSection) {
  Stretched scene(1.5, true);
  constexpr int kLast = Stretched::kEdges - 1;
  const Points& place = scene.stepper->state().position;
  for (const int node : {kLast, kLast + 1}) scene.boundary.fixed_nodes.push_back({node, place.col(node)});
  scene.boundary.fixed_twists = {{0, 0.0}, {kLast, 0.5}};
  scene.settle();
  hold_against("R18 twisted, stretched rod: torque [N m]",
               scene.rod.material.twisting_stiffness / scene.stretch * 0.5 / (Stretched::kEdge * kLast),
               scene.stepper->readings().reaction_torque(kLast), 1e-6);
}

}  // namespace
}  // namespace knot_utm
