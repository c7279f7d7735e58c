// physics.twist on the machine.

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>

#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/phase.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "machine/overhand_specimen.hpp"
#include "rod/materials.hpp"

namespace knot_utm {
namespace {

TestingMachine bench(const SpecimenOptions& specimen, GripKind grips, TwistMode twist,
                     std::optional<double> longest_step = std::nullopt) {
  MachineOptions machine;
  machine.grips = grips;
  PhysicsOptions physics;
  physics.twist = twist;
  physics.max_step = longest_step;
  return TestingMachine(specimen, pink_vps(), machine, physics);
}

/// Steps of `period` in one phase.
Sample run(TestingMachine& machine, Phase phase, int commands, double period, double speed) {
  Command command;
  machine.respond(command);
  command.phase = phase;
  command.speed = speed;
  command.step = 1;
  Sample sample;
  for (int k = 1; k <= commands; ++k) {
    command.sequence = static_cast<std::uint64_t>(k);
    command.time = period * k;
    if (phase == Phase::kPull) command.displacement = speed * command.time;
    sample = machine.respond(command);
    EXPECT_NE(sample.status, BenchStatus::kFailed) << sample.message;
  }
  return sample;
}

SpecimenOptions loop() {
  SpecimenOptions specimen;
  specimen.edge_length = 0.005;
  return specimen;
}

SpecimenOptions open_overhand() { return overhand_specimen(1.0, 0.7, 0.005); }

bool has_twist(const TestingMachine& machine) { return machine.state().twist.size() > 0; }

TEST(TwistOnTheMachine, AutoIsOnWhereClampsHoldTwoFrames) {
  const auto by_itself = [](const SpecimenOptions& specimen, GripKind grips) {
    return has_twist(bench(specimen, grips, TwistMode::kAuto));
  };
  SpecimenOptions straight;
  straight.knot = knot_named("straight");
  EXPECT_FALSE(by_itself(loop(), GripKind::kRollers));
  EXPECT_FALSE(by_itself(loop(), GripKind::kNodes));
  EXPECT_TRUE(by_itself(loop(), GripKind::kClamps));
  EXPECT_TRUE(by_itself(open_overhand(), GripKind::kClamps));
  EXPECT_FALSE(by_itself(open_overhand(), GripKind::kNodes));
  EXPECT_FALSE(by_itself(straight, GripKind::kClamps));
  EXPECT_TRUE(has_twist(bench(straight, GripKind::kClamps, TwistMode::kOn)));
  EXPECT_FALSE(has_twist(bench(open_overhand(), GripKind::kClamps, TwistMode::kOff)));
}

TEST(TwistOnTheMachine, AutoIsOnWhereFrictionRollsStrands) {
  const auto by_itself = [](double couple, FrictionAt at, double mu) {
    Material material = polypropylene();
    material.friction_couple = couple;
    material.friction_coefficient = mu;
    PhysicsOptions physics;
    physics.friction_at = at;
    return has_twist(TestingMachine(loop(), material, MachineOptions(), physics));
  };
  EXPECT_TRUE(by_itself(0.5, FrictionAt::kSurface, 0.3));
  EXPECT_FALSE(by_itself(0.5, FrictionAt::kCentreline, 0.3));
  EXPECT_FALSE(by_itself(0.0, FrictionAt::kSurface, 0.3));
  EXPECT_FALSE(by_itself(0.5, FrictionAt::kSurface, 0.0));
}

TEST(TwistOnTheMachine, ALoopTiesTheSameWithIt) {
  // Steps short enough that none is rejected, nor the first one shorter: where one of the two needs an iteration more
  // and takes another step next, paths that jump from contact to contact part by hundredths of a radius.
  constexpr double kLongestStep = 8e-4;
  TestingMachine on = bench(loop(), GripKind::kRollers, TwistMode::kOn, kLongestStep);
  TestingMachine off = bench(loop(), GripKind::kRollers, TwistMode::kOff, kLongestStep);
  const Sample with = run(on, Phase::kTie, 10, 0.1, 0.02), without = run(off, Phase::kTie, 10, 0.1, 0.02);
  const double difference = (on.state().position - off.state().position).colwise().norm().maxCoeff();
  RecordProperty("largest_difference_in_radii", std::to_string(1e6 * difference / on.rod().material.radius) + "e-6");
  ASSERT_EQ(with.steps, without.steps);
  EXPECT_LT(difference, 0.001 * on.rod().material.radius);
  EXPECT_NEAR(with.tail_force[0], without.tail_force[0], 1e-3 * without.tail_force[0]);
  EXPECT_LT(with.twisting_energy, 1e-9 * with.bending_energy);
  EXPECT_EQ(without.twisting_energy, 0.0);
}

TEST(TwistOnTheMachine, AStraightRodPullsTheSameWithIt) {
  SpecimenOptions specimen;
  specimen.knot = knot_named("straight");
  specimen.length = 0.25;
  specimen.edge_length = 0.005;
  TestingMachine on = bench(specimen, GripKind::kClamps, TwistMode::kOn);
  TestingMachine off = bench(specimen, GripKind::kClamps, TwistMode::kOff);
  const Sample with = run(on, Phase::kPull, 10, 0.1, 0.0033), without = run(off, Phase::kPull, 10, 0.1, 0.0033);
  EXPECT_GT(without.force_upper, 0.0);
  EXPECT_NEAR(with.force_upper, without.force_upper, 1e-6 * without.force_upper);
  EXPECT_EQ(with.twisting_energy, 0.0);
}

TEST(TwistOnTheMachine, AnOverhandBetweenClampsStoresIt) {
  TestingMachine on = bench(open_overhand(), GripKind::kClamps, TwistMode::kAuto);
  const Sample with = run(on, Phase::kPull, 30, 0.1, 0.0033);
  EXPECT_GT(with.twisting_energy, 1e-6 * with.bending_energy);
  EXPECT_LT(with.twisting_energy, with.bending_energy);
}

}  // namespace
}  // namespace knot_utm
