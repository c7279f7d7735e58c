#include "knot_utm/program/program_runner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "knot_utm/program/phases.hpp"
#include "program/programs.hpp"

namespace knot_utm {
namespace {

using namespace programs;
using ::testing::HasSubstr;

TEST(ProgramRunner, PeriodIsTheSamplingPeriodDividedUntilNoLongerThanTheLongest) {
  EXPECT_DOUBLE_EQ(ProgramRunner(paper_program(), 3.0, 1.0, {}).period(), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(ProgramRunner(paper_program(), 3.0, 1.0 / 3.0, {}).period(), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(ProgramRunner(paper_program(), 3.0, 0.2, {}).period(), 1.0 / 6.0);
  EXPECT_DOUBLE_EQ(ProgramRunner(paper_program(), 3.0, 0.02, {}).period(), 1.0 / 51.0);
  EXPECT_THROW(ProgramRunner({}, 3.0, 0.1, {}), std::invalid_argument);
  EXPECT_THROW(ProgramRunner(paper_program(), 0.0, 0.1, {}), std::invalid_argument);
}

TEST(ProgramRunner, CommandTimesComeFromWholeNumbers) {
  ProgramRunner program(paper_program(), 3.0, 0.1, {});
  const Answered result = run(FakeBench(), program);
  for (std::size_t n = 0; n < result.commands.size(); ++n) {
    EXPECT_EQ(result.commands[n].sequence, n);
    EXPECT_EQ(result.commands[n].time, static_cast<double>(n) / 12.0);
    EXPECT_EQ(result.commands[n].read_cell, n % 4 == 0);
    EXPECT_EQ(result.commands[n].step < 0, n == 0);
  }
}

TEST(ProgramRunner, RunsThePapersPhasesInOrder) {
  ProgramRunner program(paper_program(), 3.0, 0.1, {});
  const Answered result = run(FakeBench(), program);
  std::vector<Phase> phases;
  int balances = 0;
  for (const Command& command : result.commands) {
    if (phases.empty() || phases.back() != command.phase) phases.push_back(command.phase);
    balances += command.balance ? 1 : 0;
  }
  EXPECT_EQ(phases, (std::vector<Phase>{Phase::kIdle, Phase::kTie, Phase::kRelease, Phase::kMount, Phase::kBalance,
                                        Phase::kPull}));
  EXPECT_EQ(balances, 1);
  EXPECT_EQ(program.ended_by(), EndedBy::kExtension);
  EXPECT_EQ(program.phase(), Phase::kDone);
  EXPECT_EQ(program.reason(), "");
}

TEST(ProgramRunner, HoldLastsItsDurationInWholePeriods) {
  for (const auto& [duration, commands] : {std::pair{2.0, 24}, std::pair{2.01, 25}, std::pair{0.001, 1}}) {
    ProgramRunner program({step<HoldStep>(0.0033, duration)}, 3.0, 0.1, {});
    EXPECT_EQ(run(FakeBench(), program).commands.size(), static_cast<std::size_t>(commands + 1)) << duration;
    EXPECT_EQ(program.ended_by(), EndedBy::kProgram);
  }
}

/// Answers the commands of a program until one of its last step, in which the rod parts.
ProgramRunner parted_in_step(const Program& steps, int last) {
  ProgramRunner program(steps, 3.0, 0.1, {});
  Sample sample;
  program.next(sample);
  while (!program.ended()) {
    sample.sequence = program.last().sequence;
    sample.time = program.last().time;
    sample.balance_offset = 0.0;
    sample.load = sample.force_upper = program.last().phase == Phase::kPreload ? 20.0 : 0.0;
    sample.status = program.last().step == last ? BenchStatus::kBroken : BenchStatus::kPhaseDone;
    sample.message = "the rod parted";
    program.next(sample);
  }
  return program;
}

PreloadStep preload(double load) {
  PreloadStep out;
  out.load = load;
  out.balance = false;
  return out;
}

TEST(ProgramRunner, ARodThatPartsBeforeItIsLoadedFailsTheTest) {
  const auto hold = step<HoldStep>(0.0033, 5.0);
  for (const Phase phase : {Phase::kTie, Phase::kRelease, Phase::kMount, Phase::kBalance, Phase::kHold}) {
    ProgramStep first = *step_named(phase_name(phase));
    first->duration = 5.0;
    for (const Program& steps : {Program{first, pull(0.1)}, Program{first, preload(20.0), hold}}) {
      const ProgramRunner program = parted_in_step(steps, 0);
      EXPECT_EQ(program.ended_by(), EndedBy::kBreak);
      EXPECT_TRUE(program.failed());
      EXPECT_EQ(program.reason(), std::string(phase_name(phase)) + ": the rod parted, before it was pulled");
    }
  }
  EXPECT_TRUE(parted_in_step({BalanceStep(), hold}, 0).failed()) << "it is being prepared";
}

/// A rod that creeps, and one that bears its own weight: their break is what the test waits for.
TEST(ProgramRunner, ARodThatPartsUnderItsLoadFailsNoTest) {
  const auto hold = step<HoldStep>(0.0033, 5.0);
  HoldStep at_load = hold;
  at_load.hold_load = true;
  at_load.held_load = 20.0;
  for (const Program& steps : {Program{hold}, Program{preload(20.0), hold}, Program{preload(20.0), hold, pull(0.1)},
                               Program{at_load, pull(0.1)}, Program{TieStep(), ReleaseStep(), MountStep(), hold},
                               Program{preload(20.0), pull(0.1)}})
    for (int i = 0; i < static_cast<int>(steps.size()); ++i) {
      if (ends_by_itself(steps[static_cast<std::size_t>(i)]->phase())) continue;
      const ProgramRunner program = parted_in_step(steps, i);
      EXPECT_EQ(program.ended_by(), EndedBy::kBreak);
      EXPECT_FALSE(program.failed()) << steps.size() << " steps, parted in step " << i;
      EXPECT_EQ(program.reason(), "the rod parted");
    }
}

TEST(ProgramRunner, EndsByBreakOverloadTravelAndSolver) {
  FakeBench breaks;
  breaks.break_force = 3.0;
  ProgramRunner by_break({pull(0.1)}, 3.0, 0.1, {});
  run(breaks, by_break);
  EXPECT_EQ(by_break.ended_by(), EndedBy::kBreak);
  EXPECT_FALSE(by_break.failed());

  ProgramRunner::Limits limits;
  limits.load = 3.0;
  ProgramRunner by_overload({pull(0.1)}, 3.0, 0.1, limits);
  run(FakeBench(), by_overload);
  EXPECT_EQ(by_overload.ended_by(), EndedBy::kLoad);
  EXPECT_THAT(by_overload.reason(), HasSubstr("capacity"));

  limits = {};
  limits.travel = 0.02;
  ProgramRunner by_travel({pull(0.1)}, 3.0, 0.1, limits);
  run(FakeBench(), by_travel);
  EXPECT_EQ(by_travel.ended_by(), EndedBy::kTravel);

  FakeBench fails;
  fails.fail_time = 1.0;
  ProgramRunner by_solver({pull(0.1)}, 3.0, 0.1, {});
  run(fails, by_solver);
  EXPECT_EQ(by_solver.ended_by(), EndedBy::kSolver);
  EXPECT_THAT(by_solver.reason(), HasSubstr("converged"));
}

/// FakeBench ties for half a second, releases for one, mounts for half a second.
TEST(ProgramRunner, AKnotThatComesUndoneBeforeItIsPulledEndsTheTest) {
  struct Case {
    double undone_from;
    const char* phase;
  };
  for (const Case& one : {Case{0.2, "tie"}, Case{1.1, "release"}, Case{1.8, "mount"}}) {
    FakeBench bench;
    bench.undone_from = one.undone_from;
    ProgramRunner program({TieStep(), step<ReleaseStep>(0.0033, 1.0), MountStep(), pull(0.1)}, 3.0, 0.1, {});
    const Answered result = run(bench, program);
    EXPECT_EQ(program.ended_by(), EndedBy::kUntangled);
    EXPECT_EQ(program.reason(), std::string(one.phase) + ": the knot came undone");
    EXPECT_TRUE(program.failed());
    EXPECT_LT(result.samples.back().time, one.undone_from + 3.0 * program.period()) << "the third answer says so";
  }
}

TEST(ProgramRunner, OverloadCountsTheTrueForceInBothDirections) {
  ProgramRunner::Limits limits;
  limits.load = 20.0;
  for (const double force : {20.1, -20.1, 20.0, -20.0}) {
    ProgramRunner program({pull(0.1)}, 3.0, 0.1, limits);
    Sample sample;
    sample.force_upper = force;
    sample.load = force - 10.0 * (force > 0.0 ? 1.0 : -1.0);  // balanced at half of it
    program.next(sample);
    EXPECT_EQ(program.ended_by(), std::abs(force) > 20.0 ? EndedBy::kLoad : EndedBy::kNotYet) << force;
  }
}

TEST(ProgramRunner, OperatorStopsAndBalances) {
  ProgramRunner program({pull(0.1)}, 3.0, 0.1, {});
  Sample sample;
  sample.sequence = 0;
  EXPECT_FALSE(program.next(sample).balance);
  program.balance();
  sample.sequence = 1;
  const Command balancing = program.next(sample);
  EXPECT_TRUE(balancing.balance);
  EXPECT_EQ(balancing.phase, Phase::kPull);
  sample.sequence = 2;
  EXPECT_FALSE(program.next(sample).balance);
  program.stop();
  EXPECT_EQ(program.ended_by(), EndedBy::kOperator);
  const Command after = program.next(sample);
  EXPECT_EQ(after.phase, Phase::kDone);
  EXPECT_EQ(after.sequence, 3u);
  EXPECT_EQ(after.velocity, 0.0);
}

TEST(ProgramRunner, APlateauThatIsSettledEndsTheTestAndFailsNone) {
  ProgramRunner program({pull(0.1), step<HoldStep>(0.0033, 2.0)}, 3.0, 0.1, {});
  Sample sample;
  program.next(sample);
  program.plateau_settled("at 0.05 m");
  EXPECT_EQ(program.ended_by(), EndedBy::kPlateau);
  EXPECT_STREQ(ended_by_name(program.ended_by()), "plateau");
  EXPECT_EQ(ended_by_named("plateau"), EndedBy::kPlateau);
  EXPECT_EQ(program.reason(), "at 0.05 m");
  EXPECT_FALSE(program.failed());
  program.stop();
  EXPECT_EQ(program.ended_by(), EndedBy::kPlateau) << "it had ended";
}

}  // namespace
}  // namespace knot_utm
