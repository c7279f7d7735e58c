// The balance of energy over commands to the machine, as a test reports it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/machine/accuracy.hpp"
#include "knot_utm/machine/grips.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "rod/materials.hpp"

namespace knot_utm {
namespace {

struct Machine {
  std::string name;
  SpecimenOptions specimen;
  MachineOptions machine;
  PhysicsOptions physics;

  Machine(const char* name_, KnotKind knot, GripKind grips, RollerRotation rotation = RollerRotation::kFixed)
      : name(name_) {
    specimen.knot = knot;
    specimen.edge_length = 0.005;
    if (knot == knot_named("straight")) specimen.length = 0.25;
    machine.grips = grips;
    machine.roller_friction = grips == GripKind::kRollers ? 0.2 : 0.0;
    machine.roller_rotation = rotation;
    machine.roller_rate = rotation == RollerRotation::kTurned ? 0.1 : 0.0;
    physics.accuracy = Accuracy::kDraft;
    physics.residual = 1e-8;
    physics.gravity = {1.0, 0.0, -9.81};
    physics.inertia = 1.6;  // a loose overhand would have less, and swing faster than the bound below is good for
  }
};

class SmallPull : public testing::TestWithParam<Machine> {};

/// The residual that Newton's method may leave at every node, times a way that no node exceeds.
TEST_P(SmallPull, ClosesToNewtonsTolerance) {
  const Material material = polypropylene();
  TestingMachine bench(GetParam().specimen, material, GetParam().machine, GetParam().physics);
  const double nodes = static_cast<double>(bench.rod().nodes());
  const double residual = tolerances(GetParam().physics, GetParam().specimen, material).residual *
                          material.bending_stiffness / (material.radius * material.radius);
  constexpr double kResidualOfTension = 2e-6;
  std::vector<Sample> samples = {bench.respond(Command{})};
  double bound = 0.0, tension = 0.0, scale = 0.0;
  Command command;
  command.phase = Phase::kHold;
  command.step = 1;
  for (int k = 1; k <= 30; ++k) {
    command.sequence = static_cast<std::uint64_t>(k);
    command.time = 0.1 * k;
    if (k > 10) {
      command.phase = Phase::kPull;
      command.step = 2;
      command.displacement = 3.3e-4 * (k - 10);
    }
    ASSERT_NE(bench.respond(command).status, BenchStatus::kFailed);
    tension = std::max(tension, bench.tension().cwiseAbs().maxCoeff());
    for (const Sample& sample : bench.substeps()) {
      // A clamp's and a roller's own ways are none that a residual could stand at.
      bound +=
          (residual + kResidualOfTension * tension) * nodes * sample.fastest_node * (sample.time - samples.back().time);
      samples.push_back(sample);
      const EnergyParts parts = energy_between(samples.front(), sample);
      ASSERT_LT(std::abs(parts.gap()), bound) << sample.time;
      scale = std::max({scale, std::abs(parts.work), std::abs(parts.losses())});
    }
  }
  const Results results =
      analyse(samples, samples, EndedBy::kExtension, rollers_hold(GetParam().specimen, GetParam().machine));
  ASSERT_TRUE(results.energy);
  EXPECT_GT(results.energy->work, 0.0);
  EXPECT_LT(std::abs(results.energy->gap()), bound);
  EXPECT_LT(*results.energy_balance_error, bound / scale);
  EXPECT_LT(bound, 0.01 * scale) << "a bound that says nothing";
}

INSTANTIATE_TEST_SUITE_P(
    Balance, SmallPull,
    testing::Values(Machine("StraightInClamps", knot_named("straight"), GripKind::kClamps),
                    Machine("OverhandInClamps", knot_named("overhand"), GripKind::kClamps),
                    Machine("OverhandAtItsEnds", knot_named("overhand"), GripKind::kNodes),
                    Machine("LoopOnRollersWithFriction", knot_named("fisherman"), GripKind::kRollers),
                    Machine("LoopOnFreeRollers", knot_named("fisherman"), GripKind::kRollers, RollerRotation::kFree),
                    Machine("LoopOnDrivenRollers", knot_named("fisherman"), GripKind::kRollers,
                            RollerRotation::kTurned)),
    [](const auto& machine) { return machine.param.name; });

}  // namespace
}  // namespace knot_utm
