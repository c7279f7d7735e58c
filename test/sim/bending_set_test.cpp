// Bends that take a set: the rod is then curved at rest by a share of its bend, and pays for being rolled.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/step_control.hpp"
#include "sim/balance.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

constexpr int kEdges = 24;
constexpr double kShare = 0.6, kTurn = 2.0;  // of the arc, end to end [rad]

/// A rod as an arc, of zero natural curvature until it takes a set.
struct Arc {
  Material material = braided_rope();
  RodProperties rod;
  StepSettings settings;
  RodState state;

  Arc() {
    material.twisting_stiffness = material.bending_stiffness;
    rod = make_rod(material, Eigen::VectorXd::Constant(kEdges, material.radius));
    settings = closed_form_settings(material);
    settings.drag = 5.0;
    state = straight_state(rod);
    double angle = 0.0;
    for (int i = 1; i <= kEdges; ++i) {
      state.position.col(i) =
          state.position.col(i - 1) + material.radius * Vec3(std::cos(angle), 0.3 * std::sin(angle), 0.0).normalized();
      angle += kTurn / kEdges;
    }
    initialise_frames(&state);
    state.natural_curvature.setZero(2, rod.nodes() - 2);
  }
};

double turning_angle(const Points& x, int i) {
  const Vec3 e = (x.col(i) - x.col(i - 1)).normalized(), f = (x.col(i + 1) - x.col(i)).normalized();
  return std::atan2(e.cross(f).norm(), e.dot(f));
}

TEST(BendingSet, AFreeRodComesToRestWithTheShareOfItsBend) {
  const Arc arc;
  std::unique_ptr<TimeStep> stepper = TimeStep::make(arc.rod, arc.state, arc.settings);
  stepper->take_set(kShare);
  const Points bent = arc.state.position;
  Balance balance(std::move(stepper), arc.settings, 0.02);
  const Boundary free;
  balance.run(20.0, [&](double) -> const Boundary& { return free; });
  const Points& now = balance.stepper().state().position;
  for (int i = 1; i < kEdges; ++i) EXPECT_NEAR(turning_angle(now, i), kShare * turning_angle(bent, i), 1e-5) << i;
  EXPECT_LT(balance.stepper().readings().energies().elastic(), 1e-6 * balance.sum().numerical)
      << "all of it was let go";
}

/// What is stored above the new rest, (1 - share)^2 of it, is still there; the rest is lost in the next step.
TEST(BendingSet, LosesTheEnergyThatItTakes) {
  const Arc arc;
  std::unique_ptr<TimeStep> stepper = TimeStep::make(arc.rod, arc.state, arc.settings);
  const double before = stepper->readings().energies().bending;
  stepper->take_set(kShare);
  Boundary held;
  for (int i = 0; i <= kEdges; ++i) held.fixed_nodes.push_back({i, arc.state.position.col(i)});
  Balance balance(std::move(stepper), arc.settings, 0.02);
  balance.run(0.02, [&](double) -> const Boundary& { return held; });
  const double left = (1.0 - kShare) * (1.0 - kShare) * before;
  EXPECT_NEAR(balance.stepper().readings().energies().bending, left, 1e-9 * before);
  EXPECT_NEAR(balance.sum().numerical, before - left, 1e-9 * before);
  EXPECT_LT(std::abs(balance.gap()), balance.rounding());
}

/// A ring's worth of it, rolled about its own tangent by phi, resists with k_b kappa kappa_0 sin(phi) a length.
TEST(BendingSet, AHeldBendResistsBeingRolled) {
  const Arc arc;
  std::unique_ptr<TimeStep> stepper = TimeStep::make(arc.rod, arc.state, arc.settings);
  stepper->take_set(kShare);
  Boundary held;
  for (int i = 0; i <= kEdges; ++i) held.fixed_nodes.push_back({i, arc.state.position.col(i)});
  const double phi = 0.7;
  for (int j = 0; j < kEdges; ++j) held.fixed_twists.push_back({j, 0.0});
  for (int step = 1; step <= 12; ++step) {  // and stands still, so that no drag is in the torque
    for (FixedTwist& twist : held.fixed_twists) twist.angle = std::min(0.1 * step, 1.0) * phi;
    ASSERT_TRUE(stepper->step(held, 0.02).accepted());
  }
  for (int j = 4; j < kEdges - 4; ++j) {
    const double before = turning_angle(arc.state.position, j), behind = turning_angle(arc.state.position, j + 1);
    const double expected = arc.material.bending_stiffness / arc.material.radius * kShare * 0.5 *
                            (before * before + behind * behind) * std::sin(phi);
    // Half of it from either node, whose edge is turned against its rest by phi, and the other edge, too.
    EXPECT_NEAR(std::abs(stepper->readings().reaction_torque(j)), expected, 0.01 * expected) << j;
  }
}

/// Bending of a rod that is straight at rest knows of no natural curvature.
TEST(BendingSet, IsOnlyTakenByARodMadeForIt) {
  Arc arc;
  arc.state.natural_curvature.resize(2, 0);
  const std::unique_ptr<TimeStep> stepper = TimeStep::make(arc.rod, arc.state, arc.settings);
  EXPECT_THROW(stepper->take_set(kShare), InvalidInput);
}

}  // namespace
}  // namespace knot_utm
