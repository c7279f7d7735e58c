#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "knot_utm/machine/program_runner.hpp"
#include "knot_utm/machine/run_test.hpp"
#include "machine/fake_bench.hpp"

/// Steps and programs for tests of the program runner, and what a bench without a specimen answers to them.
namespace knot_utm::programs {

inline ProgramStep step(Phase phase, double speed = 0.0033, double duration = 0.0) {
  ProgramStep result;
  result.phase = phase;
  result.speed = speed;
  result.duration = duration;
  return result;
}

inline ProgramStep pull(double extension, double speed = 0.0033) {
  ProgramStep result = step(Phase::kPull, speed);
  result.until.extension = extension;
  result.until.broken = true;
  return result;
}

inline Program paper_program() {
  return {step(Phase::kTie), step(Phase::kRelease, 0.0033, 3.0), step(Phase::kMount), step(Phase::kBalance),
          pull(0.12)};
}

struct Course {
  std::vector<Command> commands;
  std::vector<Sample> samples;
};

inline Course run(FakeBench bench, ProgramRunner& program) {
  Course result;
  run_test(bench, program, [&](const Command& command, const Sample& sample) {
    result.commands.push_back(command);
    result.samples.push_back(sample);
    ASSERT_LT(result.commands.size(), 100000u);
  });
  return result;
}

}  // namespace knot_utm::programs
