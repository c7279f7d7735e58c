// The step that turns the upper clamp.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/program/program_runner.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "program/programs.hpp"
#include "rod/materials.hpp"

namespace knot_utm {
namespace {

using namespace programs;

constexpr double kLength = 0.25, kEdge = 0.005;
constexpr const char* kDrawn = "a file of config/knots/";
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

/// Two straight strands of a solid rod, half their length and touching, one drawn up and one down.
TestingMachine clamped_pair() {
  KnotDrawing pair;
  pair.name = "pair";
  pair.strands = {{{"lower_1", "upper_1"}, {{1, 0, -10}, {1, 0, 0}, {1, 0, 10}}},
                  {{"upper_2", "lower_2"}, {{-1, 0, 10}, {-1, 0, 0}, {-1, 0, -10}}}};
  pair.lower = {"lower_1", "lower_2"};
  pair.upper = {"upper_1", "upper_2"};
  SpecimenOptions specimen;
  specimen.knot = knot_named(kDrawn);
  specimen.drawing = std::make_shared<const KnotDrawing>(pair);
  Material solid = nylon();
  solid.stretching_stiffness = 10.0 * solid.bending_stiffness / (solid.radius * solid.radius);
  solid.friction_coefficient = 0.0;
  specimen.end_to_end = 80.0 * solid.radius;
  specimen.edge_length = solid.radius;
  MachineOptions machine;
  machine.grips = GripKind::kClamps;
  return {specimen, solid, machine, PhysicsOptions()};
}

/// All answers to a pull by `extension` and then these steps.
std::vector<Sample> answers(double extension, Program steps, TestingMachine machine = clamped_rod()) {
  steps.insert(steps.begin(), pull(extension, 1e-5));
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

/// The frames turn and the strands' ends go around: what both take is stored, as nothing else moves and nothing rubs.
TEST(TwistStep, TheWorkOfItsTorqueOnTwoStrandsIsStoredInThem) {
  const std::vector<Sample> all = answers(1e-5, {twist(4.0)}, clamped_pair());
  const auto stored = [](const Sample& s) {
    return s.stretching_energy + s.bending_energy + s.twisting_energy + s.contact_energy;
  };
  double work = 0.0;
  const Sample* before = nullptr;
  for (const Sample& sample : all) {
    if (before && std::isfinite(before->torque))
      work += 0.5 * (before->torque + sample.torque) * (sample.turn - before->turn);
    before = &sample;
  }
  const double gained = stored(all.back()) - stored(all.front());
  EXPECT_NEAR(all.back().turn, 8.0 * M_PI, 1e-9);
  // Frames alone store less: the strands also bend, and stretch as they go around.
  EXPECT_GT(gained, 1.2 * all.back().twisting_energy);
  EXPECT_NEAR(work, gained, 0.01 * gained);  // the trapezoidal rule and drag
}

}  // namespace
}  // namespace knot_utm
