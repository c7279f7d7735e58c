// What Newton's method may leave unbalanced: more in edges that bear kN, not in the slack ones beside them.

#include <gtest/gtest.h>

#include <cmath>

#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

/// A rod that is stretched by a tenth over ten edges, from node 0 to 10, with a tail of twenty.
struct RodWithTail {
  static constexpr int kStretched = 10, kTail = 20;
  const Material material = braided_rope();
  const RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(kStretched + kTail, material.radius));

  /// How far a force across moves the end of the tail in a long step [m].
  double deflection(double force, double residual_of_tension) const {
    RodState state = straight_state(rod);
    for (int i = 0; i < kStretched; ++i) state.position(0, i) -= 0.1 * (kStretched - i) * material.radius;
    StepSettings settings = closed_form_settings(material);
    settings.newton_cap = 0.03 * material.radius;  // so that one iteration does not get there
    settings.residual_of_tension = residual_of_tension;
    Boundary boundary;
    boundary.fixed_nodes = {{0, state.position.col(0)}, {kStretched, state.position.col(kStretched)}};
    boundary.forces = {{kStretched + kTail, Vec3(0.0, 0.0, force)}};
    const std::unique_ptr<TimeStep> step = TimeStep::make(rod, state, settings);
    const StepSummary summary = step->step(boundary, 1e3);
    EXPECT_TRUE(summary.accepted()) << summary.reason;
    return step->state().position(2, kStretched + kTail);
  }
};

TEST(Residual, OfASlackTailIsNotThatOfTheLoadedRodBesideIt) {
  const RodWithTail scene;
  constexpr double kOfTension = 2e-6, kForce = 4e-4;
  ASSERT_LT(kForce, kOfTension * 0.1 * scene.material.stretching_stiffness) << "it would be left unbalanced";
  const double exact = scene.deflection(kForce, 0.0);
  EXPECT_GT(exact, 0.06 * scene.material.radius);
  // The residual of closed_form_settings at the end of a cantilever, F L^3/(3 k_b).
  const double length = RodWithTail::kTail * scene.material.radius;
  const double error = 1e-8 * std::pow(length, 3) / (3.0 * scene.material.bending_stiffness);
  EXPECT_NEAR(scene.deflection(kForce, kOfTension), exact, RodWithTail::kTail * error);
}

}  // namespace
}  // namespace knot_utm
