// Plastic bending in a rod: what is bent beyond yield stays bent, and the balance of energy counts what that takes.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/rod/frames.hpp"
#include "rod/own_laws.hpp"
#include "sim/balance.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

constexpr int kEdges = 24;
constexpr double kTurn = 2.0, kYield = 0.6;  // of the arc, end to end [rad]; share of it at yield
constexpr double kHardening = 0.2;

/// A circular arc of edges that turn by `angle` at every node.
Points arc(double angle, double edge) {
  Points x = Points::Zero(3, kEdges + 1);
  for (int i = 1; i <= kEdges; ++i)
    x.col(i) = x.col(i - 1) + edge * Vec3(std::cos((i - 1) * angle), std::sin((i - 1) * angle), 0.0);
  return x;
}

struct Strip {
  Material material = braided_rope();
  RodProperties rod;
  StepSettings settings;
  RodState state;

  Strip() {
    material.twisting_stiffness = material.bending_stiffness;
    rod = make_rod(material, Eigen::VectorXd::Constant(kEdges, material.radius));
    settings = closed_form_settings(material);
    settings.drag = 5.0;
    set_law(rod, PlasticBending{kYield * kTurn / kEdges / material.radius, kHardening});
    state = straight_state(rod);
    state.natural_curvature.setZero(2, rod.nodes() - 2);
    state.position = arc(kTurn / kEdges, material.radius);
    initialise_frames(&state);
  }
};

double turning_angle(const Points& x, int i) {
  const Vec3 e = (x.col(i) - x.col(i - 1)).normalized(), f = (x.col(i + 1) - x.col(i)).normalized();
  return std::atan2(e.cross(f).norm(), e.dot(f));
}

/// It is unbent slowly: let go at once, its ends would swing back, and their inertia and drag bend the middle further.
TEST(PlasticBending, AReleasedStripKeepsWhatItsMomentDoesNotHold) {
  const Strip strip;
  Balance balance(TimeStep::make(strip.rod, strip.state, strip.settings), strip.settings, 0.02);
  const double h = strip.material.radius, bend = kTurn / kEdges, stiffness = strip.material.bending_stiffness / h;
  const double kept = bend * (1.0 - kHardening) * (1.0 - kYield);  // kappa - M/k_b
  Boundary held;
  const auto hold_at = [&](double angle) -> const Boundary& {
    const Points x = arc(angle, h);
    held.fixed_nodes.clear();
    for (int i = 0; i <= kEdges; ++i) held.fixed_nodes.push_back({i, x.col(i)});
    return held;
  };
  balance.run(0.02, [&](double) -> const Boundary& { return hold_at(bend); });
  const double dissipated = (kEdges - 1) * (1.0 - kHardening) * stiffness * kYield * bend * (1.0 - kYield) * bend;
  EXPECT_NEAR(balance.sum().plastic, dissipated, 1e-9 * dissipated);
  balance.run(1.0, [&](double to) -> const Boundary& { return hold_at(bend + (kept - bend) * (to - 0.02)); });
  EXPECT_NEAR(balance.sum().plastic, dissipated, 1e-9 * dissipated) << "unbending is elastic";
  const Boundary free;
  balance.run(5.0, [&](double) -> const Boundary& { return free; });
  for (int i = 1; i < kEdges; ++i)
    EXPECT_NEAR(turning_angle(balance.stepper().state().position, i), kept, 1e-3 * kept) << i;
  EXPECT_LT(std::abs(balance.gap()), balance.rounding());
}

/// What a stepper accounts for before its first step is what another one has left, so that the first step of a rod that
/// has yielded dissipates nothing that it did not; and a rod that is drawn bent has what it is about to dissipate.
TEST(PlasticBending, ANewStepperBeginsWithTheEnergyOfTheLastOne) {
  const Strip strip;
  const std::unique_ptr<TimeStep> stepper = TimeStep::make(strip.rod, strip.state, strip.settings);
  const double drawn = stepper->readings().energies().bending;
  Boundary held;
  for (int i = 0; i <= kEdges; ++i) held.fixed_nodes.push_back({i, strip.state.position.col(i)});
  ASSERT_TRUE(stepper->step(held, 0.02).accepted());
  const double stored = stepper->readings().energies().bending;
  EXPECT_NEAR(drawn, stored + stepper->readings().work().plastic, 1e-9 * drawn);
  EXPECT_GT(stepper->readings().work().plastic, 0.0);
  const std::unique_ptr<TimeStep> next = TimeStep::make(strip.rod, stepper->state(), strip.settings);
  EXPECT_NEAR(next->readings().energies().bending, stored, 1e-9 * stored);
}

TEST(PlasticBending, NeedsARodThatRemembersItsBends) {
  Strip strip;
  strip.state.natural_curvature.resize(2, 0);
  EXPECT_THROW(TimeStep::make(strip.rod, strip.state, strip.settings), InvalidInput);
}

}  // namespace
}  // namespace knot_utm
