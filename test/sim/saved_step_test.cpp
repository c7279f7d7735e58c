#include "knot_utm/sim/saved_step.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/rod/frames.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

/// A rod that falls onto a roller, which moves along it with friction.
struct FallingRod {
  std::unique_ptr<TimeStep> stepper;
  Boundary boundary;

  explicit FallingRod(bool twist) {
    Material material = braided_rope();
    material.twisting_stiffness = material.bending_stiffness;
    const RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(20, material.radius));
    StepSettings settings = closed_form_settings(material);
    settings.gravity = Vec3(0.5, 0.0, -9.81);
    settings.drag = 1.0;
    settings.roller_friction = MemoryFriction{0.4, 1e-3 * material.radius};
    RodState state = straight_state(rod);
    if (twist) initialise_frames(&state);
    stepper = TimeStep::make(rod, state, settings);
    boundary.rollers = {plane_below(material.radius)};
  }
};

std::vector<double> numbers(const Iterate& i) {
  return {i.residual,
          i.tolerance,
          static_cast<double>(i.node),
          static_cast<double>(i.spin),
          i.factor,
          i.motion,
          static_cast<double>(i.active),
          static_cast<double>(i.touching),
          i.overlap,
          i.arclengths[0],
          i.arclengths[1],
          static_cast<double>(i.roller)};
}

class SavedTimeStep : public testing::TestWithParam<bool> {};

TEST_P(SavedTimeStep, ComesToTheSameBitsElsewhere) {
  FallingRod scene(GetParam());
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(scene.stepper->step(scene.boundary, 0.01).accepted());
  scene.boundary.rollers[0].centre += Vec3(1e-6, 0.0, 3e-6);
  SavedStep elsewhere = load_step(save_step(*scene.stepper, scene.boundary, 0.03, 0.01), "here");
  EXPECT_EQ(elsewhere.time, 0.03);
  EXPECT_EQ(elsewhere.dt, 0.01);
  EXPECT_EQ(save_step(*elsewhere.stepper, elsewhere.boundary, 0.03, 0.01),
            save_step(*scene.stepper, scene.boundary, 0.03, 0.01));

  std::vector<std::vector<double>> here, there;
  scene.stepper->watch([&](const Iterate& iterate) { here.push_back(numbers(iterate)); });
  elsewhere.stepper->watch([&](const Iterate& iterate) { there.push_back(numbers(iterate)); });
  const StepSummary expected = scene.stepper->step(scene.boundary, 0.01), found = elsewhere.try_again();
  ASSERT_TRUE(expected.accepted()) << expected.reason;
  EXPECT_TRUE(found.accepted()) << found.reason;
  EXPECT_EQ(found.newton.residual, expected.newton.residual);
  EXPECT_EQ(there, here);
  EXPECT_EQ(elsewhere.stepper->state().position, scene.stepper->state().position);
  EXPECT_EQ(elsewhere.stepper->state().twist, scene.stepper->state().twist);
  EXPECT_EQ(elsewhere.stepper->readings().roller_force(0), scene.stepper->readings().roller_force(0));
}

INSTANTIATE_TEST_SUITE_P(Twist, SavedTimeStep, testing::Bool(),
                         [](const auto& twist) { return twist.param ? "On" : "Off"; });

std::string complaint(const std::string& content) {
  try {
    load_step(content, "file");
  } catch (const InvalidInput& invalid) {
    return invalid.what();
  }
  return "";
}

TEST(SavedTimeStepFile, IsToldFromOtherFiles) {
  FallingRod scene(true);
  scene.boundary.fixed_twists = {{3, 0.1}};
  const std::string whole = save_step(*scene.stepper, scene.boundary, 0.0, 0.01);
  EXPECT_EQ(complaint(whole), "");
  EXPECT_THAT(complaint(""), testing::HasSubstr("first line: found that of a foreign file"));
  EXPECT_THAT(complaint(whole.substr(0, whole.size() / 2)), testing::HasSubstr("length: found "));
  std::string damaged = whole;
  damaged[whole.size() / 2] = static_cast<char>(damaged[whole.size() / 2] ^ 1);
  EXPECT_THAT(complaint(damaged), testing::HasSubstr("checksum: found "));

  scene.boundary.fixed_twists[0].edge = 20;
  EXPECT_THAT(complaint(save_step(*scene.stepper, scene.boundary, 0.0, 0.01)),
              testing::HasSubstr("held edge: found 20"));
  scene.boundary.fixed_twists.clear();
  scene.boundary.forces = {{-1, Vec3::Zero()}};
  EXPECT_THAT(complaint(save_step(*scene.stepper, scene.boundary, 0.0, 0.01)),
              testing::HasSubstr("node that is pulled: found -1"));
  EXPECT_THAT(complaint(save_step(*scene.stepper, Boundary(), 0.0, 0.0)),
              testing::HasSubstr("length of the step: found 0"));
}

}  // namespace
}  // namespace knot_utm
