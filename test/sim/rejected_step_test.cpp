// A step that is not accepted changes nothing, not even what the next one makes of it.

#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

/// A rod that falls onto a roller with friction, moving along it; with and without twist, under both contact laws.
struct Scene {
  bool twist;
  ContactLaw law;

  std::unique_ptr<TimeStep> stepper() const {
    Material material = braided_rope();
    material.twisting_stiffness = material.bending_stiffness;
    const RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(20, material.radius));
    StepSettings settings = closed_form_settings(material);
    settings.contact_law = law;
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

INSTANTIATE_TEST_SUITE_P(Scenes, RejectedStep,
                         testing::Values(Scene{false, ContactLaw::kSmooth}, Scene{true, ContactLaw::kSmooth},
                                         Scene{false, ContactLaw::kEdge}, Scene{true, ContactLaw::kEdge}),
                         [](const auto& scene) {
                           return std::string(scene.param.law == ContactLaw::kEdge ? "edge" : "smooth") +
                                  (scene.param.twist ? "Twist" : "");
                         });

}  // namespace
}  // namespace knot_utm
