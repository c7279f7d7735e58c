#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/program/preparing_steps.hpp"
#include "knot_utm/program/program_runner.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {

/// A spring on the machine in place of a knot: answers commands at once, with two substeps each.
struct FakeBench {
  double stiffness = 1000.0;  ///< [N/m]
  double tie_time = 0.5;      ///< [s] until tie and mount are done
  double break_force = std::numeric_limits<double>::infinity();
  double fail_time = std::numeric_limits<double>::infinity();  ///< [s] when the physics gives up
  bool comes_to_rest = true;
  double undone_from = std::numeric_limits<double>::infinity();  ///< [s] when the knot has come undone
  double weak_from = std::numeric_limits<double>::infinity();    ///< displacement, beyond which it bears ... [m]
  double weakness = 0.3;                                         ///< ... this share

  Sample respond(const Command& command) {
    if (command.step != step_) {
      step_ = command.step;
      step_begin_ = last_.time;
    }
    if (command.balance) {
      balanced_displacement_ = last_.displacement;
      balanced_force_ = force(last_.displacement);
    }
    Sample sample;
    const double begin = last_.time;
    const double from = last_.displacement;
    substeps.clear();
    for (const double share : {0.5, 1.0}) {
      sample.sequence = command.sequence;
      sample.phase = command.phase;
      sample.time = begin + share * (command.time - begin);
      if (share == 1.0) sample.time = command.time;
      sample.displacement = from + share * (command.displacement - from);
      sample.extension = sample.displacement - balanced_displacement_;
      sample.end_to_end = 0.25 + sample.displacement;
      sample.force_upper = sample.force_lower = force(sample.displacement);
      sample.load = sample.force_upper - balanced_force_;
      sample.balance_offset = balanced_force_;
      sample.highest_load = sample.lowest_load = sample.load;
      sample.steps = ++steps_;
      if (sample.time >= undone_from) sample.knot_type = KnotType::kChanged;
      substeps.push_back(sample);
      if (command.sequence == 0) break;
    }
    const double in_step = sample.time - step_begin_;
    const bool still = command.phase == Phase::kTie || command.phase == Phase::kRelease;
    if (sample.time >= fail_time) {
      sample.status = BenchStatus::kFailed;
      sample.message = "no step of 1e-06 s or more converged";
    } else if (sample.force_upper > break_force) {
      sample.status = BenchStatus::kBroken;
    } else if ((still || command.phase == Phase::kMount) &&
               in_step >= (command.phase == Phase::kRelease ? command.duration : tie_time) - 1e-9) {
      sample.status = !comes_to_rest && still ? BenchStatus::kNotEquilibrated : BenchStatus::kPhaseDone;
    }
    for (const Sample& step : substeps) {
      sample.highest_load = std::max(sample.highest_load, step.load);
      sample.lowest_load = std::min(sample.lowest_load, step.load);
    }
    substeps.back() = sample;
    last_ = sample;
    return sample;
  }

  std::vector<Sample> substeps;

 private:
  double force(double displacement) const {
    return (displacement > weak_from ? weakness : 1.0) * stiffness * displacement;
  }

  Sample last_;
  int step_ = -1;
  double step_begin_ = 0.0;
  double balanced_displacement_ = 0.0;
  double balanced_force_ = 0.0;
  std::uint64_t steps_ = 0;
};

}  // namespace knot_utm

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
