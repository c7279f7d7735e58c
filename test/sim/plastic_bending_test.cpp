// Bends that a rod keeps because it yields, or because its fibres rub.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/turning_angle.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "rod/own_laws.hpp"
#include "sim/balance.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

constexpr int kEdges = 24;
constexpr double kTurn = 2.0, kBend = kTurn / kEdges;  // of the arc, end to end, and of a node [rad]
constexpr double kShare = 0.6;                         // of the bend, where it yields
constexpr double kHardening = 0.2;

/// A rod as a circular arc, of zero natural curvature.
struct Strip {
  Material material = braided_rope();
  RodProperties rod;
  StepSettings settings;
  RodState state;

  explicit Strip(const BendingLaws& law = ElasticBending()) {
    material.twisting_stiffness = material.bending_stiffness;
    rod = make_rod(material, Eigen::VectorXd::Constant(kEdges, material.radius));
    settings = closed_form_settings(material);
    settings.drag = 5.0;
    set_law(rod, law);
    state = straight_state(rod);
    remember_bends(rod, &state);
    state.position = arc(kBend);
    initialise_frames(&state);
  }
  static Strip that_yields() { return Strip(PlasticBending{kShare * kBend / braided_rope().radius, kHardening}); }

  /// Edges that turn by `angle` at every node.
  Points arc(double angle) const {
    Points x = Points::Zero(3, kEdges + 1);
    for (int i = 1; i <= kEdges; ++i)
      x.col(i) = x.col(i - 1) + material.radius * Vec3(std::cos((i - 1) * angle), std::sin((i - 1) * angle), 0.0);
    return x;
  }
  Boundary held_at(double angle) const {
    Boundary out;
    const Points x = arc(angle);
    for (int i = 0; i <= kEdges; ++i) out.fixed_nodes.push_back({i, x.col(i)});
    return out;
  }
  std::unique_ptr<TimeStep> stepper() const { return TimeStep::make(rod, state, settings); }
};

void expect_bends(const Points& x, double bend, double error) {
  const Points t = tangents(x);
  for (int i = 1; i < kEdges; ++i) EXPECT_NEAR(turning_angle(t.col(i - 1), t.col(i)), bend, error) << i;
}

/// It is unbent slowly: let go at once, its ends would swing back, and their inertia and drag bend the middle further.
TEST(PlasticBending, AReleasedStripKeepsWhatItsMomentDoesNotHold) {
  const Strip strip = Strip::that_yields();
  Balance balance(strip.stepper(), strip.settings, 0.02);
  const double stiffness = strip.material.bending_stiffness / strip.material.radius;
  const double kept = kBend * (1.0 - kHardening) * (1.0 - kShare);  // kappa - M/k_b
  Boundary held;
  balance.run(0.02, [&](double) -> const Boundary& { return held = strip.held_at(kBend); });
  const double dissipated = (kEdges - 1) * (1.0 - kHardening) * stiffness * kShare * kBend * (1.0 - kShare) * kBend;
  EXPECT_NEAR(balance.sum().plastic, dissipated, 1e-9 * dissipated);
  balance.run(1.0,
              [&](double to) -> const Boundary& { return held = strip.held_at(kBend + (kept - kBend) * (to - 0.02)); });
  EXPECT_NEAR(balance.sum().plastic, dissipated, 1e-9 * dissipated) << "unbending is elastic";
  const Boundary free;
  balance.run(5.0, [&](double) -> const Boundary& { return free; });
  expect_bends(balance.stepper().state().position, kept, 1e-3 * kept);
  EXPECT_LT(std::abs(balance.gap()), balance.rounding());
}

/// What a stepper accounts for before its first step is what another one has left, so that the first step of a rod that
/// has yielded dissipates nothing that it did not; and a rod that is drawn bent has what it is about to dissipate.
TEST(PlasticBending, ANewStepperBeginsWithTheEnergyOfTheLastOne) {
  const Strip strip = Strip::that_yields();
  const std::unique_ptr<TimeStep> stepper = strip.stepper();
  const double drawn = stepper->readings().energies().bending;
  ASSERT_TRUE(stepper->step(strip.held_at(kBend), 0.02).accepted());
  const double stored = stepper->readings().energies().bending;
  EXPECT_NEAR(drawn, stored + stepper->readings().work().plastic, 1e-9 * drawn);
  EXPECT_GT(stepper->readings().work().plastic, 0.0);
  const std::unique_ptr<TimeStep> next = TimeStep::make(strip.rod, stepper->state(), strip.settings);
  EXPECT_NEAR(next->readings().energies().bending, stored, 1e-9 * stored);
}

FrictionalBending with_fibres(double bend_left) {
  FrictionalBending law;
  law.stick_ratio = 20.0;
  law.curvature = bend_left / braided_rope().radius;  // M_y/k_b
  law.by_tension = 1e-4 / braided_rope().radius;
  return law;
}

/// Bent over a mandrel and let go, a strip keeps the curvature M_y/k_b and has lost M_y (2 kappa - 3 y - M_y/k_b) a
/// length, y = M_y/((s - 1) k_b) being the bend at which its fibres slide: its friction moment turned round once.
TEST(FrictionalBending, AStripLetGoOfAMandrelKeepsItsFrictionMomentOverItsStiffness) {
  constexpr double kLeft = 0.3 * kBend;
  const Strip strip(with_fibres(kLeft));
  Balance balance(strip.stepper(), strip.settings, 0.02);
  Boundary held;
  balance.run(0.02, [&](double) -> const Boundary& { return held = strip.held_at(kBend); });
  balance.run(1.0, [&](double to) -> const Boundary& {
    return held = strip.held_at(kBend + (kLeft - kBend) * std::min(2.0 * (to - 0.02), 1.0));  // and stands still
  });
  const Boundary free;
  balance.run(5.0, [&](double) -> const Boundary& { return free; });
  expect_bends(balance.stepper().state().position, kLeft, 1e-3 * kLeft);
  const double stiffness = strip.material.bending_stiffness / strip.material.radius, slides = kLeft / 19.0;
  const double lost = (kEdges - 1) * stiffness * kLeft * (2.0 * kBend - 3.0 * slides - kLeft);
  EXPECT_NEAR(balance.sum().plastic, lost, 1e-3 * lost);
  EXPECT_LT(std::abs(balance.gap()), balance.rounding());
}

/// What a law remembers besides the bend is part of the state: each node keeps the tension that has compacted it, a
/// copy of the state goes on from there, and a saved state has it. A jerk of a tenth of a millisecond hardly counts.
TEST(FrictionalBending, TheRodRemembersTheLargestTensionThatLasts) {
  Strip strip(with_fibres(0.05));
  strip.state.position = strip.arc(0.0);
  const std::unique_ptr<TimeStep> stepper = strip.stepper();
  const auto stretch = [&](double strain, double dt) {
    Boundary held;
    for (int i = 0; i <= kEdges; ++i) held.fixed_nodes.push_back({i, (1.0 + strain) * strip.state.position.col(i)});
    return stepper->step(held, dt).accepted();
  };
  const double tension = 3e-3 * strip.material.stretching_stiffness;
  ASSERT_TRUE(stretch(3e-3, 1e-4));
  EXPECT_LT(stepper->state().bending_own.maxCoeff(), 2e-3 * tension);
  for (int step = 0; step < 25; ++step) ASSERT_TRUE(stretch(3e-3, 0.02));
  for (int step = 0; step < 25; ++step) ASSERT_TRUE(stretch(2e-3, 0.02));
  const Eigen::VectorXd largest = stepper->state().bending_own;
  ASSERT_EQ(largest.size(), kEdges - 1);
  for (const double each : largest) EXPECT_NEAR(each, tension, 1e-3 * tension);

  Archive saved("state");
  RodState again = strip.state, copy = stepper->state();
  saved(copy);
  Archive loaded("state", saved.bytes(), "a file");
  loaded(again);
  EXPECT_EQ(again.bending_own, largest);
  again.bending_own.resize(0);
  EXPECT_THROW(require_fits(strip.rod, again), InvalidInput);
}

}  // namespace
}  // namespace knot_utm
