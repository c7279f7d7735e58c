// Steps that are not accepted change nothing, and a state that is saved goes on to the same bits elsewhere.

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>

#include "knot_utm/rod/frames.hpp"
#include "sim/saved.hpp"
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

std::string name_of(const testing::TestParamInfo<Scene>& scene) { return scene.param.twist ? "Twist" : "Plain"; }
const auto kScenes = testing::Values(Scene{false}, Scene{true});

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

INSTANTIATE_TEST_SUITE_P(Scenes, RejectedStep, kScenes, name_of);

class SavedTimeStep : public testing::TestWithParam<Scene> {};

TEST_P(SavedTimeStep, ComesToTheSameBitsElsewhere) {
  const std::unique_ptr<TimeStep> stepper = GetParam().stepper(), elsewhere = GetParam().stepper();
  Boundary boundary = Scene::boundary(0.0);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(stepper->step(boundary, 0.01).accepted());
  load(saved(*stepper), *elsewhere);
  EXPECT_EQ(saved(*elsewhere), saved(*stepper));
  boundary.rollers[0].centre += Vec3(1e-6, 0.0, 3e-6);
  const StepSummary expected = stepper->step(boundary, 0.01), found = elsewhere->step(boundary, 0.01);
  ASSERT_TRUE(expected.accepted()) << expected.reason;
  EXPECT_TRUE(found.accepted()) << found.reason;
  EXPECT_EQ(found.newton.residual, expected.newton.residual);
  EXPECT_EQ(found.newton.iterations, expected.newton.iterations);
  EXPECT_EQ(saved(*elsewhere), saved(*stepper));
}

INSTANTIATE_TEST_SUITE_P(Scenes, SavedTimeStep, kScenes, name_of);

}  // namespace
}  // namespace knot_utm
