#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <tuple>
#include <vector>

#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/program/preparing_steps.hpp"
#include "knot_utm/program/program_runner.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {

/// A spring on the machine in place of a knot: answers commands at once.
struct FakeBench {
  double stiffness = 1000.0;  ///< [N/m]
  double tie_time = 0.5;      ///< [s] until tie and mount are done
  double break_force = std::numeric_limits<double>::infinity();
  double fail_time = std::numeric_limits<double>::infinity();    ///< [s] when the physics gives up
  double undone_from = std::numeric_limits<double>::infinity();  ///< [s] when the knot has come undone
  double weak_from = std::numeric_limits<double>::infinity();  ///< displacement [m], beyond which it bears 0.3 of that

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
    sample.sequence = command.sequence;
    sample.phase = command.phase;
    sample.time = command.time;
    sample.displacement = command.displacement;
    sample.extension = sample.displacement - balanced_displacement_;
    sample.end_to_end = 0.25 + sample.displacement;
    sample.force_upper = sample.force_lower = force(sample.displacement);
    sample.load = sample.force_upper - balanced_force_;
    sample.balance_offset = balanced_force_;
    const double half_way = force(0.5 * (last_.displacement + sample.displacement)) - balanced_force_;
    std::tie(sample.lowest_load, sample.highest_load) = std::minmax(half_way, sample.load);
    if (sample.time >= undone_from) sample.knot_type = KnotType::kChanged;
    const double lasts = command.phase == Phase::kRelease ? command.duration : tie_time;
    if (sample.time >= fail_time) {
      sample.status = BenchStatus::kFailed;
      sample.message = "no step of 1e-06 s or more converged";
    } else if (sample.force_upper > break_force) {
      sample.status = BenchStatus::kBroken;
    } else if (ends_by_itself(command.phase) && sample.time - step_begin_ >= lasts - 1e-9) {
      sample.status = BenchStatus::kPhaseDone;
    }
    last_ = sample;
    return sample;
  }

 private:
  double force(double displacement) const { return (displacement > weak_from ? 0.3 : 1.0) * stiffness * displacement; }

  Sample last_;
  int step_ = -1;
  double step_begin_ = 0.0;
  double balanced_displacement_ = 0.0;
  double balanced_force_ = 0.0;
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

inline PreloadStep preload(double load, bool balance = false) {
  auto out = step<PreloadStep>(0.001);
  out.load = load;
  out.balance = balance;
  return out;
}

struct Answered {
  std::vector<Command> commands;
  std::vector<Sample> samples;
};

/// Until the program has ended, or waits for its operator.
template <class Bench>
Answered run(Bench bench, ProgramRunner& program) {
  Answered result;
  while (!program.ended() && !program.waits() && result.samples.size() < 100000) {
    result.commands.push_back(program.last());
    result.samples.push_back(bench.respond(program.last()));
    program.next(result.samples.back());
  }
  return result;
}

}  // namespace knot_utm::programs
