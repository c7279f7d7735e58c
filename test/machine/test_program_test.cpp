#include "knot_utm/machine/test_program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "knot_utm/machine/run_test.hpp"
#include "machine/fake_bench.hpp"

namespace knot_utm {
namespace {

using ::testing::HasSubstr;

ProgramStep step(Phase phase, double speed = 0.0033, double duration = 0.0) {
  ProgramStep result;
  result.phase = phase;
  result.speed = speed;
  result.duration = duration;
  return result;
}

ProgramStep pull(double extension, double speed = 0.0033) {
  ProgramStep result = step(Phase::kPull, speed);
  result.until.extension = extension;
  result.until.broken = true;
  return result;
}

Program paper_program() {
  return {step(Phase::kTie), step(Phase::kRelease, 0.0033, 3.0), step(Phase::kMount), step(Phase::kBalance),
          pull(0.12)};
}

struct Record {
  std::vector<Command> commands;
  std::vector<Sample> samples;
};

Record run(FakeBench bench, TestProgram& program) {
  Record result;
  run_test(bench, program, [&](const Command& command, const Sample& sample) {
    result.commands.push_back(command);
    result.samples.push_back(sample);
    ASSERT_LT(result.commands.size(), 100000u);
  });
  return result;
}

TEST(TestProgram, PeriodIsTheSamplingPeriodDividedUntilNoLongerThanTheLongest) {
  EXPECT_DOUBLE_EQ(TestProgram(paper_program(), 3.0, 1.0, {}).period(), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(TestProgram(paper_program(), 3.0, 1.0 / 3.0, {}).period(), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(TestProgram(paper_program(), 3.0, 0.2, {}).period(), 1.0 / 6.0);
  EXPECT_DOUBLE_EQ(TestProgram(paper_program(), 3.0, 0.02, {}).period(), 1.0 / 51.0);
  EXPECT_THROW(TestProgram({}, 3.0, 0.1, {}), std::invalid_argument);
  EXPECT_THROW(TestProgram(paper_program(), 0.0, 0.1, {}), std::invalid_argument);
}

TEST(TestProgram, CommandTimesComeFromWholeNumbers) {
  TestProgram program(paper_program(), 3.0, 0.1, {});
  const Record result = run(FakeBench(), program);
  for (std::size_t n = 0; n < result.commands.size(); ++n) {
    EXPECT_EQ(result.commands[n].sequence, n);
    EXPECT_EQ(result.commands[n].time, static_cast<double>(n) / 12.0);
    EXPECT_EQ(result.commands[n].read_cell, n % 4 == 0);
    EXPECT_EQ(result.commands[n].step < 0, n == 0);
  }
}

TEST(TestProgram, RunsThePapersPhasesInOrder) {
  TestProgram program(paper_program(), 3.0, 0.1, {});
  const Record result = run(FakeBench(), program);
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

TEST(TestProgram, CrossheadMovesOnlyInMountPreloadAndPull) {
  ProgramStep preload = step(Phase::kPreload, 0.001);
  preload.load = 20.0;
  TestProgram program({step(Phase::kTie), step(Phase::kRelease, 0.0033, 1.0), step(Phase::kMount), preload,
                       step(Phase::kBalance), pull(0.01), step(Phase::kHold, 0.0033, 2.0)},
                      3.0, 0.1, {});
  const Record result = run(FakeBench(), program);
  for (std::size_t n = 1; n < result.commands.size(); ++n) {
    const Command& command = result.commands[n];
    const double moved = command.displacement - result.commands[n - 1].displacement;
    EXPECT_NEAR(moved, command.velocity * program.period(), 1e-15);
    const bool moves =
        command.phase == Phase::kMount || command.phase == Phase::kPreload || command.phase == Phase::kPull;
    EXPECT_EQ(command.velocity, moves ? command.speed : 0.0);
  }
  EXPECT_EQ(program.ended_by(), EndedBy::kProgram);
}

TEST(TestProgram, PullEndsAtTheFirstSampleAtOrBeyondItsExtension) {
  TestProgram program({step(Phase::kBalance), pull(0.01)}, 3.0, 1.0, {});
  const Record result = run(FakeBench(), program);
  const std::size_t n = result.samples.size();
  EXPECT_GE(result.samples[n - 1].extension, 0.01);
  EXPECT_LT(result.samples[n - 2].extension, 0.01);
}

TEST(TestProgram, HoldLastsItsDurationInWholePeriods) {
  for (const auto& [duration, commands] : {std::pair{2.0, 24}, std::pair{2.01, 25}, std::pair{0.001, 1}}) {
    TestProgram program({step(Phase::kHold, 0.0033, duration)}, 3.0, 0.1, {});
    EXPECT_EQ(run(FakeBench(), program).commands.size(), static_cast<std::size_t>(commands + 1)) << duration;
    EXPECT_EQ(program.ended_by(), EndedBy::kProgram);
  }
}

TEST(TestProgram, UntilLoadAndUntilTime) {
  ProgramStep to_load = step(Phase::kPull, 0.01);
  to_load.until.load = 5.0;
  TestProgram by_load({to_load}, 3.0, 0.1, {});
  EXPECT_GE(run(FakeBench(), by_load).samples.back().load, 5.0);
  EXPECT_EQ(by_load.ended_by(), EndedBy::kLoad);

  ProgramStep to_time = step(Phase::kPull, 0.01);
  to_time.until.time = 1.0;
  TestProgram by_time({to_time}, 3.0, 0.1, {});
  EXPECT_DOUBLE_EQ(run(FakeBench(), by_time).samples.back().time, 1.0);
  EXPECT_EQ(by_time.ended_by(), EndedBy::kProgram);
}

TEST(TestProgram, EndsByBreakOverloadTravelAndSolver) {
  FakeBench breaks;
  breaks.break_force = 3.0;
  TestProgram by_break({pull(0.1)}, 3.0, 0.1, {});
  run(breaks, by_break);
  EXPECT_EQ(by_break.ended_by(), EndedBy::kBreak);

  TestProgram::Limits limits;
  limits.load = 3.0;
  TestProgram by_overload({pull(0.1)}, 3.0, 0.1, limits);
  run(FakeBench(), by_overload);
  EXPECT_EQ(by_overload.ended_by(), EndedBy::kLoad);
  EXPECT_THAT(by_overload.reason(), HasSubstr("capacity"));

  limits = {};
  limits.travel = 0.02;
  TestProgram by_travel({pull(0.1)}, 3.0, 0.1, limits);
  run(FakeBench(), by_travel);
  EXPECT_EQ(by_travel.ended_by(), EndedBy::kTravel);

  FakeBench fails;
  fails.fail_time = 1.0;
  TestProgram by_solver({pull(0.1)}, 3.0, 0.1, {});
  run(fails, by_solver);
  EXPECT_EQ(by_solver.ended_by(), EndedBy::kSolver);
  EXPECT_THAT(by_solver.reason(), HasSubstr("converged"));
}

TEST(TestProgram, OverloadCountsTheTrueForceInBothDirections) {
  TestProgram::Limits limits;
  limits.load = 20.0;
  for (const double force : {20.1, -20.1, 20.0, -20.0}) {
    TestProgram program({pull(0.1)}, 3.0, 0.1, limits);
    Sample sample;
    sample.force_upper = force;
    sample.load = force - 10.0 * (force > 0.0 ? 1.0 : -1.0);  // balanced at half of it
    program.next(sample);
    EXPECT_EQ(program.ended_by(), std::abs(force) > 20.0 ? EndedBy::kLoad : EndedBy::kNotYet) << force;
  }
}

TEST(TestProgram, GoesOnWithWhatDoesNotComeToRestAsWithWhatDoes) {
  FakeBench calm, restless;
  restless.comes_to_rest = false;
  TestProgram rested(paper_program(), 3.0, 0.1, {}), moving(paper_program(), 3.0, 0.1, {});
  const Record with_rest = run(calm, rested), without = run(restless, moving);
  EXPECT_EQ(moving.ended_by(), EndedBy::kExtension);
  EXPECT_EQ(without.commands.size(), with_rest.commands.size());
}

TEST(TestProgram, OperatorStopsAndBalances) {
  TestProgram program({pull(0.1)}, 3.0, 0.1, {});
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

TEST(TestProgram, TakesNoAnswerToAnotherCommand) {
  TestProgram program({pull(0.1)}, 3.0, 0.1, {});
  Sample sample;
  sample.sequence = 7;
  EXPECT_THROW(program.next(sample), std::invalid_argument);
}

TEST(TestProgram, ProgressGrowsFromZeroToOne) {
  TestProgram program(paper_program(), 3.0, 0.1, {});
  FakeBench bench;
  double last = -1e-9;
  run_test(bench, program, [&](const Command& command, const Sample&) {
    EXPECT_GE(program.progress(), 0.0);
    EXPECT_LE(program.progress(), 1.0);
    // Steps that end by themselves may end early or late; within a step the share only grows.
    if (command.phase == Phase::kPull) {
      EXPECT_GE(program.progress(), last);
    }
    last = command.phase == Phase::kPull ? program.progress() : -1.0;
  });
  EXPECT_EQ(program.progress(), 1.0);
  EXPECT_EQ(program.time_left(), 0.0);
}

}  // namespace
}  // namespace knot_utm
