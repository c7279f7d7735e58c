// Twist in the time step: the energy of a shaft, natural shapes, a rod that is free to turn.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>

#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/specimen/material.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

constexpr int kEdges = 40;
constexpr double kEdge = 1.0 / kEdges;

/// A thin rod of unit length and bending stiffness along +x. Nothing touches.
struct Bare {
  RodProperties rod;
  RodState state;
  StepSettings settings;
  Boundary boundary;
  std::shared_ptr<TimeStep> step;

  explicit Bare(double twisting_stiffness) {
    Material material;
    material.radius = 0.005;
    material.density = 1.0;
    material.stretching_stiffness = 2e3;
    material.bending_stiffness = 1.0;
    material.twisting_stiffness = twisting_stiffness;
    rod = make_rod(material, Eigen::VectorXd::Constant(kEdges, kEdge));
    state.position = Points::Zero(3, kEdges + 1);
    for (int i = 0; i <= kEdges; ++i) state.position(0, i) = kEdge * i;
    state.velocity = Points::Zero(3, kEdges + 1);
    initialise_frames(&state);
    settings.pressure_law = NormalLaw{1.0, 1e-3};
    settings.drag = 100.0;
    settings.residual = 1e-9;
    settings.newton_cap = 0.1;
    settings.motion_limit = 0.2;
    settings.overlap_limit = 1.0;
    settings.candidate_margin = 0.01;
  }

  void begin() { step = TimeStep::make(rod, state, settings); }
  void hold(int node) { boundary.fixed_nodes.push_back({node, state.position.col(node)}); }

  void settle(double time) {
    StepControl::Options options;
    options.longest = 1.0;
    options.motion = 0.02;
    double from = 0.0;
    run_to(time, *step, from, options, [this](double) -> const Boundary& { return boundary; });
  }

  void go(double dt) {
    const StepSummary summary = step->step(boundary, dt);
    EXPECT_TRUE(summary.accepted()) << summary.reason << ", residual " << summary.newton.residual;
  }
};

/// A rod clamped at its first edge that is let go relaxes into its natural shape.
TEST(Natural, ShapeIsTheRodAtRest) {
  Bare bare(0.8);
  const double turn = 0.08;  // of a node [rad]
  bare.state.natural_curvature = Eigen::Matrix2Xd::Zero(2, kEdges - 1);
  bare.state.natural_curvature.row(0).setConstant(turn);
  bare.hold(0);
  bare.hold(1);
  bare.boundary.fixed_twists = {{0, 0.0}};
  bare.settings.drag = 1.0;
  bare.begin();
  bare.settle(100.0);
  const RodState& end = bare.step->state();
  const Energies energies = bare.step->readings().energies();
  EXPECT_LT(energies.bending + energies.twisting + energies.stretching, 1e-12);
  for (int i = 1; i < kEdges; ++i) {
    const Vec3 e = end.position.col(i) - end.position.col(i - 1), f = end.position.col(i + 1) - end.position.col(i);
    EXPECT_NEAR(std::acos(e.normalized().dot(f.normalized())), turn, 1e-6);
  }
  const Vec3 m1 = end.reference_director.col(0);
  // An arc in the plane of the tangent and m1, bent towards m1.
  const double radius = 0.5 * kEdge / std::sin(0.5 * turn);
  const Vec3 tip = end.position.col(kEdges);
  const double angle = turn * kEdges;  // edges 0 to N-1 are chords of the arc through all nodes
  EXPECT_NEAR((tip - end.position.col(0)).norm(), 2.0 * radius * std::sin(0.5 * angle), 1e-6);
  EXPECT_GT(m1.dot(tip), 0.0);
  EXPECT_NEAR(tip.dot(Vec3::UnitX().cross(m1)), 0.0, 1e-6);
}

/// Largest difference of positions, with twist and without, after a bent rod that is free at both ends has sprung and
/// been pulled about out of plane [m].
double difference_of_a_free_rod(bool spin_inertia) {
  Bare on(0.3);
  for (int i = 0; i <= kEdges; ++i) {
    const double angle = 4.0 * kEdge * i;
    on.state.position.col(i) << 0.25 * std::cos(angle), 0.25 * std::sin(angle), 0.05 * angle;
  }
  initialise_frames(&on.state);
  on.settings.drag = 20.0;
  on.settings.spin_inertia = spin_inertia;
  on.rod.material.radius = on.settings.overlap_limit = 0.02;
  on.boundary.forces = {{kEdges / 3, Vec3(5.0, 0.0, -10.0)}, {kEdges, Vec3(0.0, 5.0, 5.0)}};
  on.hold(kEdges / 2);
  Bare off = on;
  off.state.twist.resize(0);
  on.begin();
  off.begin();
  double largest = 0.0;
  for (int k = 0; k < 200; ++k) {
    on.go(0.002);
    off.go(0.002);
    largest = std::max(largest, (on.step->state().position - off.step->state().position).cwiseAbs().maxCoeff());
  }
  EXPECT_GT((on.step->state().position - on.state.position).cwiseAbs().maxCoeff(), 0.2) << "it should have moved";
  return largest;
}

TEST(Twist, ARodFreeToTurnMovesAsWithoutIt) {
  EXPECT_LT(difference_of_a_free_rod(false), 1e-8);
  EXPECT_LT(difference_of_a_free_rod(true), 1e-3);
}

}  // namespace
}  // namespace knot_utm
