// Sections that are flattened and grow thin: forces, stiffnesses and torques against closed forms.

#include "knot_utm/contact/soft_section.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "knot_utm/rod/frames.hpp"
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
