// Steps that a load, a course of turning points or a record leads, and what ends them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "program/programs.hpp"

namespace knot_utm {
namespace {

using namespace programs;
using ::testing::HasSubstr;

PreloadStep preload(double load, bool balance = true) {
  auto out = step<PreloadStep>(0.001);
  out.load = load;
  out.balance = balance;
  return out;
}

TEST(LedSteps, PreloadMeetsItsLoadAndBalancesStandingStill) {
  ProgramRunner program({preload(2.0), pull(0.01)}, 3.0, 0.1, {});
  const Answered result = run(FakeBench(), program);
  std::size_t first = 1;
  while (result.commands[first].phase == Phase::kPreload) ++first;
  const Command& last = result.commands[first - 1];
  EXPECT_TRUE(last.balance);
  EXPECT_EQ(last.velocity, 0.0);
  EXPECT_NEAR(result.samples[first - 1].force_upper, 2.0, 2e-3);  // kMetLoad
  EXPECT_EQ(result.samples[first - 1].load, 0.0);
  EXPECT_NEAR(result.samples[first].load, 1000.0 * 0.0033 * program.period(), 1e-12);

  ProgramRunner unbalanced({preload(2.0, false), pull(0.01)}, 3.0, 0.1, {});
  for (const Command& command : run(FakeBench(), unbalanced).commands) EXPECT_FALSE(command.balance);
}

TEST(LedSteps, ErrorsOfTheCellLeadNothing) {
  struct WrongCell : FakeBench {
    Sample respond(const Command& command) {
      Sample sample = FakeBench::respond(command);
      if (command.read_cell) sample.load = 1.1 * sample.load + 0.3;
      return sample;
    }
  };
  auto hold = step<HoldStep>(0.0033, 3.0);
  hold.hold_load = true;
  hold.held_load = 7.0;
  ProgramRunner program({preload(2.0, false), hold}, 3.0, 0.1, {});
  WrongCell bench;
  double last = 0.0;
  run_test(bench, program, [&](const Command&, const Sample& sample) { last = sample.force_upper; });
  EXPECT_NEAR(last, 7.0, 1e-9);
}

TEST(LedSteps, PullsAtARateOfLoad) {
  auto by_load = step<PullStep>(0.01);
  by_load.load_rate = 2.0;
  by_load.until.load = 10.0;
  ProgramRunner program({by_load}, 3.0, 0.1, {});
  const Answered result = run(FakeBench(), program);
  // The first command finds out how stiff the spring is.
  for (std::size_t n = 2; n < result.samples.size(); ++n)
    EXPECT_NEAR(result.samples[n].load, 2.0 * result.samples[n].time, 1e-9);
  EXPECT_EQ(program.ended_by(), EndedBy::kLoad);
}

TEST(LedSteps, CyclesBetweenExtensionsThatItMeets) {
  CycleStep cycle;
  cycle.extension = fields::LowHigh{0.001, 0.004};
  cycle.cycles = 3;
  ProgramRunner program({BalanceStep(), cycle}, 3.0, 0.1, {});
  const Answered result = run(FakeBench(), program);
  int highs = 0, lows = 0;
  for (const Sample& sample : result.samples) {
    EXPECT_LE(sample.extension, 0.004 + 1e-12);
    highs += std::abs(sample.extension - 0.004) < 1e-12 ? 1 : 0;
    lows += std::abs(sample.extension - 0.001) < 1e-12 ? 1 : 0;
  }
  EXPECT_EQ(highs, 3);
  EXPECT_EQ(lows, 3);
  EXPECT_NEAR(result.samples.back().extension, 0.001, 1e-12);
  EXPECT_EQ(program.ended_by(), EndedBy::kProgram);
}

TEST(LedSteps, CyclesBetweenLoadsByCountOrTime) {
  CycleStep cycle;
  cycle.load = fields::LowHigh{1.0, 4.0};
  cycle.cycles = 2;
  ProgramRunner by_count({cycle}, 3.0, 0.1, {});
  const Answered counted = run(FakeBench(), by_count);
  constexpr double kMet = 3e-3;  // kMetLoad of the range
  double highest = 0.0;
  for (const Sample& sample : counted.samples) highest = std::max(highest, sample.load);
  EXPECT_NEAR(highest, 4.0, kMet);
  EXPECT_NEAR(counted.samples.back().load, 1.0, kMet);

  cycle.cycles = 0;
  cycle.time = 10.0;
  ProgramRunner by_time({cycle}, 3.0, 0.1, {});
  EXPECT_DOUBLE_EQ(run(FakeBench(), by_time).samples.back().time, 10.0);
  EXPECT_EQ(by_time.ended_by(), EndedBy::kProgram);
}

TEST(LedSteps, ReturnsToAnExtensionOrALoad) {
  ProgramRunner home({BalanceStep(), pull(0.01), ReturnStep()}, 3.0, 0.1, {});
  EXPECT_NEAR(run(FakeBench(), home).samples.back().extension, 0.0, 1e-12);
  EXPECT_EQ(home.ended_by(), EndedBy::kExtension);

  ReturnStep unload;
  unload.load = 3.0;
  ProgramRunner to_load({BalanceStep(), pull(0.01), unload}, 3.0, 0.1, {});
  EXPECT_NEAR(run(FakeBench(), to_load).samples.back().load, 3.0, 1e-3 * 10.3);  // kMetLoad of where it began
  EXPECT_EQ(to_load.ended_by(), EndedBy::kLoad);
}

TEST(LedSteps, FollowsARecordFromWhereItStands) {
  FollowStep follow;
  follow.recorded = {{0.0, 0.5}, {1.0, 0.502}, {1.5, 0.501}, {3.0, 0.507}};
  ProgramRunner program({pull(0.01), follow}, 3.0, 0.1, {});
  const Answered result = run(FakeBench(), program);
  double begin = 0.0, from = 0.0;
  for (std::size_t n = 1; n < result.samples.size(); ++n) {
    const Sample& sample = result.samples[n];
    if (sample.phase != Phase::kFollow) {
      begin = sample.time;
      from = sample.displacement;
      continue;
    }
    const double t = sample.time - begin, way = sample.displacement - from;
    const double expected = t <= 1.0 ? 0.002 * t : t <= 1.5 ? 0.002 - 0.002 * (t - 1.0) : 0.001 + 0.004 * (t - 1.5);
    EXPECT_NEAR(way, std::min(expected, 0.007), 1e-12) << t;
  }
  EXPECT_EQ(program.ended_by(), EndedBy::kProgram);
}

TEST(LedSteps, ADropThatIsABreakEndsIt) {
  FakeBench weak;
  weak.weak_from = 0.008;
  ProgramRunner::Limits limits;
  limits.breaks.fraction_of_peak = 0.4;
  limits.breaks.arming_load = 5.0;
  ProgramRunner program({pull(0.1)}, 3.0, 0.1, limits);
  const Answered result = run(weak, program);
  EXPECT_EQ(program.ended_by(), EndedBy::kBreak);
  EXPECT_THAT(program.reason(), HasSubstr("the load fell"));
  EXPECT_NEAR(result.samples.back().displacement, 0.008, 0.0033 * program.period());

  // On the way in of a cycle loads fall as they should.
  CycleStep cycle;
  cycle.extension = fields::LowHigh{0.0, 0.007};
  cycle.cycles = 2;
  ProgramRunner cycles({BalanceStep(), cycle}, 3.0, 0.1, limits);
  run(weak, cycles);
  EXPECT_EQ(cycles.ended_by(), EndedBy::kProgram);
}

TEST(LedSteps, GripsThatMeetEndIt) {
  auto home = step<ReturnStep>(0.01);
  home.extension = -1.0;
  ProgramRunner::Limits limits;
  limits.least_distance = 0.1;  // from 0.25 m on
  ProgramRunner program({home}, 3.0, 0.1, limits);
  EXPECT_NEAR(run(FakeBench(), program).samples.back().end_to_end, 0.1, 0.01 * program.period());
  EXPECT_EQ(program.ended_by(), EndedBy::kTravel);
  EXPECT_THAT(program.reason(), HasSubstr("the grips meet"));
}

}  // namespace
}  // namespace knot_utm
