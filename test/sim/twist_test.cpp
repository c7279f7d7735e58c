// Twist in the time step: closed forms, buckling, natural shapes.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/step_control.hpp"
#include "knot_utm/sim/time_step.hpp"
#include "knot_utm/specimen/material.hpp"
#include "reference.hpp"

namespace knot_utm {
namespace {

constexpr double kPi = M_PI;
constexpr int kEdges = 40;
constexpr int kLast = kEdges - 1;  // edge
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

  /// Turns the frames of the two ends, and evenly those between, until the torque of the straight rod is `torque`.
  void hold_frames_of_a_shaft(double torque) {
    const double per_edge = torque / rod.material.twisting_stiffness * kEdge;
    state.twist.setLinSpaced(kEdges, 0.0, per_edge * kLast);
    boundary.fixed_twists = {{0, 0.0}, {kLast, per_edge * kLast}};
  }

  void begin() { step = TimeStep::make(rod, state, settings); }
  void hold(int node) { boundary.fixed_nodes.push_back({node, state.position.col(node)}); }

  void settle(double time) {
    StepControl::Options options;
    options.longest = 1.0;
    options.motion = 0.02;
    StepControl control(options);
    double from = 0.0;
    const std::string gave_up = control.advance(
        *step, from, time, [this](double, double) -> const Boundary& { return boundary; },
        [](double, double, const StepSummary&) {});
    EXPECT_EQ(gave_up, "");
  }

  /// Newton iterations.
  int go(double dt) {
    const StepSummary summary = step->step(boundary, dt);
    EXPECT_TRUE(summary.accepted()) << summary.reason << ", residual " << summary.newton.residual;
    return summary.newton.iterations;
  }
};

TEST(Twist, AClampThatTurnsStoresTheEnergyOfAShaft) {
  Bare bare(0.6);
  bare.hold(0);
  bare.hold(1);
  bare.hold(kEdges - 1);
  bare.hold(kEdges);
  bare.begin();
  const double length = 1.0 - kEdge;  // from the middle of the first edge to that of the last
  // Far beyond a turn: angles wind up, they do not jump.
  for (const double angle : {0.1, 1.0, 2.5, 5.0, 7.5, 10.0}) {
    bare.boundary.fixed_twists = {{0, 0.0}, {kLast, angle}};
    bare.settings.drag = 0.0;
    for (int k = 0; k < 60; ++k) bare.go(1.0);
    EXPECT_NEAR(bare.step->readings().energies().twisting, 0.6 * angle * angle / (2.0 * length), 1e-6 * angle * angle);
    EXPECT_NEAR(bare.step->readings().reaction_torque(kLast), 0.6 * angle / length, 1e-6 * angle);
    EXPECT_NEAR(bare.step->readings().reaction_torque(0), -0.6 * angle / length, 1e-6 * angle);
    EXPECT_LT(bare.step->readings().energies().bending, 1e-20);
  }
}

/// Rate [1/s] at which a small bend of a hinged rod grows while its ends' frames are turned so far that the torque is
/// `torque`. The ends are held, so the rod carries no force while it is straight.
double growth(double torque) {
  Bare bare(1.0);
  for (int i = 0; i <= kEdges; ++i) {
    const double s = kEdge * i;
    bare.state.position(1, i) = 1e-6 * std::sin(kPi * s);
  }
  initialise_frames(&bare.state);
  bare.hold(0);
  bare.hold(kEdges);
  bare.hold_frames_of_a_shaft(torque);
  bare.begin();
  const auto size = [&] { return bare.step->state().position.bottomRows(2).norm(); };
  for (int k = 0; k < 40; ++k) bare.go(0.1);
  const double before = size();
  for (int k = 0; k < 40; ++k) bare.go(0.1);
  return std::log(size() / before) / 4.0;
}

TEST(R4_EulerBuckling, TorqueOnAHingedRodInTheTimeStep) {
  // Frames held at hinges turn with the end edges: their torque follows the tangent. Without a force along the rod
  // that buckles at 2 pi B/L, as the torque about a fixed axis does.
  const double low = growth(0.98 * 2.0 * kPi), high = growth(1.02 * 2.0 * kPi);
  EXPECT_LT(low, 0.0);
  EXPECT_GT(high, 0.0);
  const double critical = 0.98 + 0.04 * low / (low - high);
  hold_against("R4 torque on a hinged rod, in the time step: M L/(2 pi B)", 1.0, critical, 0.01);
}

TEST(Twist, NewtonConvergesInFewIterationsFarBeyondBuckling) {
  Bare bare(0.7);
  for (int i = 0; i <= kEdges; ++i) {
    const double s = kEdge * i;
    bare.state.position.col(i) << 0.9 * s, 0.01 * std::sin(kPi * s), 0.01 * std::sin(2.0 * kPi * s);
  }
  initialise_frames(&bare.state);
  for (const int node : {0, 1, kEdges - 1, kEdges}) bare.hold(node);
  bare.begin();
  const double dt = 0.05, turning = 1.0;  // [s], [rad/s]
  int worst = 0, sum = 0, steps = 0;
  for (double time = dt; time < 15.0; time += dt) {
    bare.boundary.fixed_twists = {{0, 0.0}, {kLast, turning * time}};
    const int iterations = bare.go(dt);
    worst = std::max(worst, iterations);
    sum += iterations;
    ++steps;
  }
  RecordProperty("iterations_a_step", std::to_string(static_cast<double>(sum) / steps));
  RecordProperty("most_iterations", worst);
  EXPECT_GT(bare.step->state().position.bottomRows(2).cwiseAbs().maxCoeff(), 0.05) << "it should have buckled";
  EXPECT_LE(worst, 15) << "where it snaps";
  EXPECT_LT(sum, 3 * steps);
}

/// A rod clamped at its first edge that is let go relaxes into its natural shape.
class Natural : public testing::TestWithParam<double> {};

TEST_P(Natural, ShapeIsTheRodAtRest) {
  Bare bare(0.8);
  const double turn = 0.08, twist = GetParam();  // of a node [rad]
  bare.state.natural_curvature = Eigen::Matrix2Xd::Zero(2, kEdges - 1);
  bare.state.natural_curvature.row(0).setConstant(turn * std::cos(0.5 * twist));
  bare.rod.natural_twist = Eigen::VectorXd::Constant(kEdges - 1, twist);
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
  if (twist == 0.0) {
    // An arc in the plane of the tangent and m1, bent towards m1.
    const double radius = 0.5 * kEdge / std::sin(0.5 * turn);
    const Vec3 tip = end.position.col(kEdges);
    const double angle = turn * kEdges;  // edges 0 to N-1 are chords of the arc through all nodes
    EXPECT_NEAR((tip - end.position.col(0)).norm(), 2.0 * radius * std::sin(0.5 * angle), 1e-6);
    EXPECT_GT(m1.dot(tip), 0.0);
    EXPECT_NEAR(tip.dot(Vec3::UnitX().cross(m1)), 0.0, 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(ArcAndHelix, Natural, testing::Values(0.0, 0.1));

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
  const double exact = difference_of_a_free_rod(false), with_inertia = difference_of_a_free_rod(true);
  RecordProperty("without_spin_inertia", std::to_string(1e9 * exact) + "e-9");
  RecordProperty("with_spin_inertia", std::to_string(1e9 * with_inertia) + "e-9");
  EXPECT_LT(exact, 1e-8);
  EXPECT_LT(with_inertia, 1e-3);
}

TEST(Twist, ARodWithNaturalCurvatureNeedsFrames) {
  Bare bare(1.0);
  bare.state.natural_curvature = Eigen::Matrix2Xd::Constant(2, kEdges - 1, 0.1);
  bare.state.twist.resize(0);
  EXPECT_THROW(TimeStep::make(bare.rod, bare.state, bare.settings), InvalidInput);
}

TEST(Twist, AStepThatIsNotAcceptedChangesNothing) {
  Bare bare(1.0);
  bare.hold(0);
  bare.hold(1);
  bare.begin();
  bare.boundary.fixed_twists = {{0, 0.0}};
  bare.go(0.1);
  const RodState before = bare.step->state();
  bare.boundary.fixed_twists = {{0, 1.0}, {kLast, -2.0}};
  bare.boundary.forces = {{kEdges, Vec3(0.0, 1e4, 0.0)}};
  EXPECT_FALSE(bare.step->step(bare.boundary, 0.1).accepted());
  EXPECT_EQ(bare.step->state().twist, before.twist);
  EXPECT_EQ(bare.step->state().twist_rate, before.twist_rate);
  EXPECT_EQ(bare.step->state().reference_director, before.reference_director);
  EXPECT_EQ(bare.step->state().reference_twist, before.reference_twist);
}

}  // namespace
}  // namespace knot_utm
