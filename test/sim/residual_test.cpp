// What Newton's method may leave unbalanced: more in edges that bear kN, not in the slack ones beside them.

#include <gtest/gtest.h>

#include <cmath>

#include "knot_utm/rod/rod.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

/// A rod that is stretched by a tenth over ten edges, from node 0 to 10, with a tail of twenty.
struct RodWithTail {
  static constexpr int kStretched = 10, kTail = 20;
  const Material material = braided_rope();
  const RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(kStretched + kTail, material.radius));

  RodState stretched() const {
    RodState state = straight_state(rod);
    for (int i = 0; i < kStretched; ++i) state.position(0, i) -= 0.1 * (kStretched - i) * material.radius;
    return state;
  }
  std::unique_ptr<TimeStep> make(StepSettings settings) const {
    settings.newton_cap = 0.03 * material.radius;  // so that one iteration does not get there
    return TimeStep::make(rod, stretched(), settings);
  }
  /// A long step with that force across the end of the tail [N].
  StepSummary step(TimeStep& step, double force, double force_on_the_loaded = 0.0) const {
    const Points position = stretched().position;
    Boundary boundary;
    boundary.fixed_nodes = {{0, position.col(0)}, {kStretched, position.col(kStretched)}};
    boundary.forces = {{kStretched + kTail, Vec3(0.0, 0.0, force)},
                       {kStretched / 2, Vec3(0.0, 0.0, force_on_the_loaded)}};
    return step.step(boundary, 1e3);
  }

  /// How far the force moves the end of the tail [m].
  double deflection(double force, double residual_of_tension) const {
    StepSettings settings = closed_form_settings(material);
    settings.residual_of_tension = residual_of_tension;
    const std::unique_ptr<TimeStep> stepper = make(settings);
    const StepSummary summary = step(*stepper, force);
    EXPECT_TRUE(summary.accepted()) << summary.reason;
    return stepper->state().position(2, kStretched + kTail);
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

TEST(Residual, ADiagnosisIsOfTheNodeThatNewtonsMethodMeasuredTheLargestAt) {
  const RodWithTail scene;
  StepSettings settings = closed_form_settings(scene.material);
  settings.residual_of_tension = 2e-6;
  settings.max_iterations = 1;
  const std::unique_ptr<TimeStep> stepper = scene.make(settings);
  const StepSummary summary = scene.step(*stepper, 1e-3, 1e-2);
  ASSERT_FALSE(summary.newton.converged());
  EXPECT_GT(summary.diagnosis.node, RodWithTail::kStretched) << "the larger force is on a node whose edges are taut";
  EXPECT_EQ(summary.diagnosis.residual, summary.newton.residual);
}

/// What is left unbalanced may shake a rod in short steps; less so one that a drag holds back while it settles.
TEST(Residual, WhileAShapeSettlesItShrinksLessWithTheStep) {
  const RodWithTail scene;
  StepSettings settings = closed_form_settings(scene.material);
  settings.residual_from_step = 1.0;
  const std::unique_ptr<TimeStep> stepper = scene.make(settings);
  Boundary boundary;
  boundary.fixed_nodes = {{0, scene.stretched().position.col(0)}};
  EXPECT_LT(stepper->step(boundary, 1e-3).newton.tolerance, 0.01 * settings.residual);
  const double mass = scene.rod.mass[1] / scene.rod.voronoi_length[1];  // [kg/m]
  boundary.extra_drag = 4e4 * mass;                                     // 1 + c dt/m = 401
  EXPECT_NEAR(stepper->step(boundary, 1e-2).newton.tolerance, 1e-4 * 401.0 * settings.residual,
              1e-6 * settings.residual);
  boundary.extra_drag = 1e9 * mass;
  EXPECT_EQ(stepper->step(boundary, 1e-2).newton.tolerance, settings.residual);
}

}  // namespace
}  // namespace knot_utm
