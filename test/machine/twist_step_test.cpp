// The step that turns the upper clamp.
#include <gtest/gtest.h>

#include <cmath>

#include "knot_utm/machine/run_test.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/record/loading_steps.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "machine/programs.hpp"
#include "rod/materials.hpp"

namespace knot_utm {
namespace {

using namespace programs;

constexpr double kLength = 0.25, kEdge = 0.005;
constexpr double kTwisted = kLength + kEdge;  // clamps hold the frames of edges, each of which lies in one

TwistStep twist(double turns, double rate = 1.0) {
  TwistStep out;
  out.turns = turns;
  out.rate = rate;
  return out;
}

TestingMachine clamped_rod() {
  SpecimenOptions specimen;
  specimen.knot = knot_named("straight");
  specimen.length = kLength;
  specimen.edge_length = kEdge;
  MachineOptions machine;
  machine.grips = GripKind::kClamps;
  PhysicsOptions physics;
  physics.twist = TwistMode::kOn;
  return {specimen, nylon(), machine, physics};
}

/// All answers of a straight rod to a pull by `extension` and then these steps.
std::vector<Sample> answers(double extension, Program steps) {
  steps.insert(steps.begin(), pull(extension, 1e-5));
  TestingMachine machine = clamped_rod();
  ProgramRunner program(steps, 6.0, 1.0, {});
  std::vector<Sample> out;
  run_test(machine, program, [&](const Command&, const Sample& sample) { out.push_back(sample); });
  EXPECT_FALSE(program.failed()) << program.reason();
  return out;
}

/// M = k_t phi/L, and the energy that the clamp gives is stored.
TEST(TwistStep, AStraightRodBearsItsTorsionalStiffnessTimesItsRateOfTwist) {
  const std::vector<Sample> all = answers(1e-5, {twist(3.0), twist(-4.5)});
  double largest = 0.0, work = 0.0;
  for (const Sample& sample : all) {
    // The rod at rest: what its inertia adds while it turns evenly is less than the residual of a spin.
    EXPECT_NEAR(sample.torque, nylon().twisting_stiffness * sample.turn / kTwisted, 1e-8);
    largest = std::max(largest, sample.turn);
    if (sample.turn == 0.0) work = sample.grip_work;
  }
  EXPECT_NEAR(largest, 6.0 * M_PI, 1e-9);
  EXPECT_NEAR(all.back().turn, -3.0 * M_PI, 1e-9);
  EXPECT_NEAR(all.back().grip_work - work, all.back().twisting_energy, 1e-3 * all.back().twisting_energy);
}

TEST(TwistStep, EndsByItsTurnsOrEarlierByItsTorque) {
  TwistStep until = twist(-40.0);
  until.torque = 1e-3;
  const std::vector<Sample> all = answers(1e-5, {until});
  const double turn = 1e-3 * kTwisted / nylon().twisting_stiffness;
  EXPECT_LE(all.back().turn, -turn);
  EXPECT_GT(all.back().turn, -turn - 2.0 * M_PI / 6.0);  // the turn in one command
}

}  // namespace
}  // namespace knot_utm
