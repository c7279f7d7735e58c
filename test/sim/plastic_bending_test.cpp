// Plastic bending in a rod: what is bent beyond yield stays bent, and the balance of energy counts what that takes.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/rod/frames.hpp"
#include "sim/balance.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

constexpr int kEdges = 24;
constexpr double kTurn = 2.0, kYield = 0.6;  // of the arc, end to end [rad]; share of it at yield
constexpr double kHardening = 0.2;

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
    settings.bending = PlasticBending{kYield * kTurn / kEdges / material.radius, kHardening};
    state = straight_state(rod);
    state.natural_curvature.setZero(2, rod.nodes() - 2);
    double angle = 0.0;
    for (int i = 1; i <= kEdges; ++i, angle += kTurn / kEdges)
      state.position.col(i) = state.position.col(i - 1) + material.radius * Vec3(std::cos(angle), std::sin(angle), 0.0);
    initialise_frames(&state);
  }
};

double turning_angle(const Points& x, int i) {
  const Vec3 e = (x.col(i) - x.col(i - 1)).normalized(), f = (x.col(i + 1) - x.col(i)).normalized();
  return std::atan2(e.cross(f).norm(), e.dot(f));
}

TEST(PlasticBending, AReleasedStripKeepsWhatItsMomentDoesNotHold) {
  const Strip strip;
  Balance balance(TimeStep::make(strip.rod, strip.state, strip.settings), strip.settings, 0.02);
  Boundary held;
  for (int i = 0; i <= kEdges; ++i) held.fixed_nodes.push_back({i, strip.state.position.col(i)});
  balance.run(0.02, [&](double) -> const Boundary& { return held; });
  const double bend = kTurn / kEdges, stiffness = strip.material.bending_stiffness / strip.material.radius;
  const double dissipated = (kEdges - 1) * (1.0 - kHardening) * stiffness * kYield * bend * (1.0 - kYield) * bend;
  const double kept = bend * (1.0 - kHardening) * (1.0 - kYield);  // kappa - M/k_b
  EXPECT_NEAR(balance.sum().plastic, dissipated, 1e-9 * dissipated);
  EXPECT_LT(std::abs(balance.gap()), balance.rounding());
  const Boundary free;
  balance.run(20.0, [&](double) -> const Boundary& { return free; });
  for (int i = 1; i < kEdges; ++i) EXPECT_NEAR(turning_angle(balance.stepper().state().position, i), kept, 1e-5) << i;
  EXPECT_LT(std::abs(balance.gap()), balance.rounding());
}

TEST(PlasticBending, NeedsARodThatRemembersItsBends) {
  Strip strip;
  strip.state.natural_curvature.resize(2, 0);
  EXPECT_THROW(TimeStep::make(strip.rod, strip.state, strip.settings), InvalidInput);
}

}  // namespace
}  // namespace knot_utm
