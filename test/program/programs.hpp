#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/program/preparing_steps.hpp"
#include "knot_utm/program/program_runner.hpp"
#include "program/fake_bench.hpp"

/// Steps and programs for tests of the program runner, and what a bench without a specimen answers to them.
namespace knot_utm::programs {

template <class Own>
Own step(double speed = 0.0033, double duration = 0.0) {
  Own result;
  result.speed = speed;
  result.duration = duration;
  return result;
}

inline PullStep pull(double extension, double speed = 0.0033) {
  auto result = step<PullStep>(speed);
  result.until.extension = extension;
  result.until.broken = true;
  return result;
}

inline Program paper_program() { return {TieStep(), ReleaseStep(), MountStep(), BalanceStep(), pull(0.12)}; }

struct Answered {
  std::vector<Command> commands;
  std::vector<Sample> samples;
};

inline Answered run(FakeBench bench, ProgramRunner& program) {
  Answered result;
  run_test(bench, program, [&](const Command& command, const Sample& sample) {
    result.commands.push_back(command);
    result.samples.push_back(sample);
    ASSERT_LT(result.commands.size(), 100000u);
  });
  return result;
}

}  // namespace knot_utm::programs
