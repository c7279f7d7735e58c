// physics.twist on the machine.

#include <gtest/gtest.h>

#include <vector>

#include "knot_utm/machine/test_bench.hpp"

namespace knot_utm {
namespace {

Material pink_vps() {
  Material material;
  material.radius = 3.175e-3;
  material.density = 1150.0;
  material.stretching_stiffness = 1.70;
  material.bending_stiffness = 4.34e-6;
  material.twisting_stiffness = 2.893e-6;
  material.friction_coefficient = 0.54;
  material.tying_preload = 1.7;
  return material;
}

TestBench bench(const SpecimenOptions& specimen, GripKind grips, TwistMode twist, double residual = 2e-5) {
  MachineOptions machine;
  machine.grips = grips;
  PhysicsOptions physics;
  physics.twist = twist;
  physics.residual = residual;
  return TestBench(specimen, pink_vps(), machine, physics);
}

/// Steps of `period` in one phase.
Sample run(TestBench& machine, Phase phase, int commands, double period, double speed) {
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

SpecimenOptions open_overhand() {
  SpecimenOptions specimen;
  specimen.knot = KnotKind::kOverhand;
  specimen.length = 1.0;
  specimen.end_to_end = 0.7;
  specimen.edge_length = 0.005;
  return specimen;
}

TEST(Twist, LoopTiesTheSameWithIt) {
  for (double residual : {2e-5, 2e-6, 2e-7, 2e-8}) {
  TestBench on = bench(loop(), GripKind::kRollers, TwistMode::kOn, residual), off = bench(loop(), GripKind::kRollers, TwistMode::kOff, residual);
  for (int i = 0; i < 1; ++i) {
  const Sample with = run(on, Phase::kTie, 20, 0.1, 0.02), without = run(off, Phase::kTie, 20, 0.1, 0.02);
  const Points diff = on.state().position - off.state().position;
  printf("res %g: max diff %g m, tail %.9g %.9g, steps %lu %lu rej %lu %lu it %lu %lu, twist E %g bend %g\n", residual, diff.colwise().norm().maxCoeff(), with.tail_force[0], without.tail_force[0], with.steps, without.steps, with.rejected_steps, without.rejected_steps, with.newton_iterations, without.newton_iterations, with.twisting_energy, with.bending_energy);
  printf("maxrate %g\n", on.state().twist_rate.cwiseAbs().maxCoeff());
  }
  }
}

TEST(Twist, OverhandBetweenClampsHasIt) {
  for (TwistMode mode : {TwistMode::kAuto, TwistMode::kOff}) {
  TestBench machine = bench(open_overhand(), GripKind::kClamps, mode);
  const Sample s = run(machine, Phase::kPull, 100, 0.1, 0.0033);
  printf("F %.9g twist %g bend %g steps %lu rej %lu it %lu twistsize %ld\n", s.force_upper, s.twisting_energy, s.bending_energy, s.steps, s.rejected_steps, s.newton_iterations, machine.state().twist.size());
  }
}

}  // namespace
}  // namespace knot_utm
