#include "knot_utm/sim/saved_step.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/phase.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/rod/frames.hpp"
#include "machine/overhand_specimen.hpp"
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

TEST(WatchedTimeStep, IsToldOfEveryIterate) {
  FallingRod scene(false);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(scene.stepper->step(scene.boundary, 0.01).accepted());
  scene.boundary.forces = {{7, Vec3(0.0, 0.0, -0.1)}};
  std::vector<Iterate> seen;
  scene.stepper->watch([&](const Iterate& iterate) { seen.push_back(iterate); });
  const StepSummary summary = scene.stepper->step(scene.boundary, 1e-3);
  ASSERT_TRUE(summary.accepted()) << summary.reason;
  ASSERT_EQ(seen.size(), static_cast<std::size_t>(summary.newton.iterations) + 1);
  EXPECT_EQ(seen.front().node, 7) << "where it is pulled";
  EXPECT_EQ(seen.front().factor, 0.0);
  EXPECT_GT(seen[1].factor, 0.0);
  EXPECT_GT(seen[1].motion, 0.0);
  EXPECT_EQ(seen.back().residual, summary.newton.residual);
  EXPECT_EQ(seen.back().tolerance, summary.newton.tolerance);
  EXPECT_GT(seen.back().touching, 0);
  EXPECT_EQ(seen.back().roller, 0);
  EXPECT_GT(seen.back().overlap, scene.stepper->settings().pressure_law.begin());
  EXPECT_LE(std::abs(seen.back().arclengths[0] - scene.stepper->rod().arclength()[7]), 2 * braided_rope().radius);
}

/// A knot on the machine whose crosshead jumps: the step fails, and fails the same way elsewhere.
TEST(FailedTimeStep, FailsForTheSameReasonElsewhere) {
  MachineOptions machine;
  machine.grips = GripKind::kClamps;
  PhysicsOptions physics;
  physics.accuracy = Accuracy::kDraft;
  TestingMachine bench(overhand_specimen(0.4, 0.15, 0.006), pink_vps(), machine, physics);
  Command command;
  bench.respond(command);
  command.phase = Phase::kPull;
  command.step = 1;
  for (command.sequence = 1; command.sequence <= 10; ++command.sequence) {
    command.time += 0.3;
    ASSERT_EQ(bench.respond(command).status, BenchStatus::kRunning);
    EXPECT_EQ(bench.failed_step(), "");
  }
  command.time += 2e-6;
  command.displacement = 0.1;
  const Sample failed = bench.respond(command);
  ASSERT_EQ(failed.status, BenchStatus::kFailed);
  ASSERT_GT(failed.contacts, 0);

  SavedStep step = load_step(bench.failed_step(), "here");
  EXPECT_EQ(step.time, failed.time);
  EXPECT_EQ(step.stepper->state().position, bench.state().position);
  StepSummary first;
  for (int i = 0; i < 2; ++i) {
    const StepSummary summary = step.try_again();
    EXPECT_FALSE(summary.accepted());
    std::ostringstream residual;
    residual << "(residual " << summary.newton.residual << " N, tolerance " << summary.newton.tolerance << " N";
    EXPECT_THAT(failed.message, testing::HasSubstr(summary.reason));
    EXPECT_THAT(failed.message, testing::HasSubstr(residual.str()));
    if (i == 0) first = summary;
    EXPECT_EQ(summary.newton.residual, first.newton.residual) << "what failed has changed nothing";
  }
}

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
