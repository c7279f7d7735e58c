// Steps that are not accepted change nothing.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

/// A rod that falls onto a roller with friction, moving along it; with and without twist.
struct Scene {
  bool twist;

  std::unique_ptr<TimeStep> stepper() const {
    Material material = braided_rope();
    material.twisting_stiffness = material.bending_stiffness;
    const RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(20, material.radius));
    StepSettings settings = closed_form_settings(material);
    settings.gravity = Vec3(0.5, 0.0, -9.81);
    settings.drag = 1.0;
    settings.roller_friction = MemoryFriction{0.4, 1e-3 * material.radius};
    RodState state = straight_state(rod);
    if (twist) initialise_frames(&state);
    return TimeStep::make(rod, state, settings);
  }
  static Boundary boundary(double raised_by) {
    Boundary out;
    out.rollers = {plane_below(braided_rope().radius)};
    out.rollers[0].centre += Vec3(0.3, 0.0, 1.0) * raised_by;
    return out;
  }
};

class RejectedStep : public testing::TestWithParam<Scene> {};

TEST_P(RejectedStep, TheNextOneIsAsIfItHadNotBeenTried) {
  const double radius = braided_rope().radius;
  for (const int before : {0, 3}) {
    const std::unique_ptr<TimeStep> tried = GetParam().stepper(), plain = GetParam().stepper();
    for (int i = 0; i < before; ++i) {
      ASSERT_TRUE(tried->step(Scene::boundary(0.0), 0.01).accepted());
      ASSERT_TRUE(plain->step(Scene::boundary(0.0), 0.01).accepted());
    }
    // Further into the rod than a step may move it.
    EXPECT_FALSE(tried->step(Scene::boundary(10.0 * radius), 0.01).accepted());
    EXPECT_EQ(tried->readings().energies().contact, plain->readings().energies().contact);
    if (before > 0) {
      EXPECT_EQ(tried->readings().roller_force(0), plain->readings().roller_force(0));
    }
    for (int i = 1; i <= 3; ++i) {
      ASSERT_TRUE(tried->step(Scene::boundary(1e-3 * radius * i), 0.01).accepted());
      ASSERT_TRUE(plain->step(Scene::boundary(1e-3 * radius * i), 0.01).accepted());
    }
    EXPECT_EQ(tried->state().position, plain->state().position);
    EXPECT_EQ(tried->state().velocity, plain->state().velocity);
    EXPECT_EQ(tried->state().twist, plain->state().twist);
    EXPECT_EQ(tried->readings().roller_force(0), plain->readings().roller_force(0));
    EXPECT_NE(plain->readings().roller_force(0)[0], 0.0) << "friction should have had its part";
  }
}

TEST_P(RejectedStep, WhatIsNotANumberIsNeverAccepted) {
  const std::unique_ptr<TimeStep> stepper = GetParam().stepper();
  ASSERT_TRUE(stepper->step(Scene::boundary(0.0), 0.01).accepted());
  const Points position = stepper->state().position;
  for (const int node : {0, 7, 20}) {
    Boundary boundary = Scene::boundary(0.0);
    boundary.forces = {{node, Vec3(0.0, std::numeric_limits<double>::quiet_NaN(), 0.0)}};
    const StepSummary summary = stepper->step(boundary, 0.01);
    EXPECT_FALSE(summary.accepted());
    EXPECT_EQ(summary.newton.end, NewtonSummary::End::kNotFinite);
    EXPECT_EQ(stepper->state().position, position);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, RejectedStep, testing::Values(Scene{false}, Scene{true}),
                         [](const auto& scene) { return scene.param.twist ? "Twist" : "Plain"; });

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
