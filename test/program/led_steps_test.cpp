// Steps that a load, a course of turning points or a record leads, and what ends them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "knot_utm/program/course.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/tying/tied_loop.hpp"
#include "program/programs.hpp"

namespace knot_utm {
namespace {

using testing::HasSubstr;

using namespace programs;

TEST(LedSteps, PreloadMeetsItsLoadAndBalancesStandingStill) {
  ProgramRunner program({preload(2.0, true), pull(0.01)}, 3.0, 0.1, {});
  const Answered result = run(FakeBench(), program);
  std::size_t first = 1;
  while (result.commands[first].phase == Phase::kPreload) ++first;
  const Command& last = result.commands[first - 1];
  EXPECT_TRUE(last.balance);
  EXPECT_EQ(last.velocity, 0.0);
  EXPECT_NEAR(result.samples[first - 1].force_upper, 2.0, 2e-3);  // kLoadTolerance
  EXPECT_EQ(result.samples[first - 1].load, 0.0);
  EXPECT_NEAR(result.samples[first].load, 1000.0 * 0.0033 * program.period(), 1e-12);

  ProgramRunner unbalanced({preload(2.0), pull(0.01)}, 3.0, 0.1, {});
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
  ProgramRunner program({preload(2.0), hold}, 3.0, 0.1, {});
  EXPECT_NEAR(run(WrongCell(), program).samples.back().force_upper, 7.0, 1e-9);
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
  constexpr double kMet = 3e-3;  // kLoadTolerance of the range
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
  EXPECT_NEAR(run(FakeBench(), to_load).samples.back().load, 3.0, 1e-3 * 10.3);  // kLoadTolerance of where it began
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

constexpr double kPeriod = 0.1, kFastest = 0.01;  // [s], [m/s]

/// A spring, and how its load is led.
struct Spring {
  double stiffness;
  Sample now = {};
  LoadControl control = {};

  void step(double wanted) {
    now.displacement += kPeriod * control.following(now, wanted, kPeriod, kFastest);
    now.force_upper = stiffness * now.displacement;
  }
};

TEST(LoadControl, CatchesUpWithASpringThatTurnsSoft) {
  Spring spring{1e6};
  for (int n = 1; n < 10; ++n) spring.step(n);
  spring.stiffness = 1e4;
  spring.now.displacement = spring.now.force_upper / spring.stiffness;
  spring.control.begin();
  for (int n = 10; n < 40; ++n) spring.step(n);
  EXPECT_NEAR(spring.now.force_upper, 39.0, 1e-9);
}

/// Where the load no longer rises with the crosshead the estimate halves at every step, until the crosshead goes as
/// fast as it may.
TEST(LoadControl, RunsAfterALoadThatDoesNotRise) {
  LoadControl control;
  Sample now;
  double speed = control.following(now, 1.0, kPeriod, kFastest);
  EXPECT_GT(speed, 0.0);
  now.displacement += kPeriod * speed;
  now.force_upper = 0.5;
  for (int n = 0; n < 40; ++n) {
    speed = control.following(now, 1.0, kPeriod, kFastest);
    now.displacement += kPeriod * speed;
  }
  EXPECT_EQ(speed, kFastest);
}

constexpr double kRadius = 0.003, kTaut = 0.3, kSpeed = 0.0033;

struct Loop {
  double slack = 0.0;         ///< until it bears something [m]
  double stiffness = 3000.0;  ///< from there on [N/m]
  double least_load = 0.0;    ///< however far back [N]
  double slide = 0.0;         ///< of the knots, over the way of the crosshead

  double load(double way) const { return std::max(least_load, stiffness * (way - slack)); }
};

struct Taken {
  double way = 0.0, most = 0.0, least = 0.0, load = 0.0;
  bool done = false;
};

Taken take_up(const Loop& loop, double step) {
  TakeUpSlack taking(kTaut, kRadius);
  taking.begin(loop.load(0.0), 0.0, 0.15);
  Taken out;
  for (int k = 0; k < 100000 && !taking.done(); ++k) {
    out.way += taking.velocity() * kSpeed * step;
    out.most = std::max(out.most, out.way);
    out.least = std::min(out.least, out.way);
    out.load = loop.load(out.way);
    taking.follow(out.load, out.way, 0.15 - loop.slide * out.way);
  }
  out.done = taking.done();
  EXPECT_EQ(taking.velocity(), 0.0);
  return out;
}

TEST(TakeUpSlack, StopsAtTheSameLoadInSoftAndStiffLoopsAtAnyStep) {
  for (const double stiffness : {200.0, 3e3, 3e4})
    for (const double slack : {0.0, 1e-3, 5e-3})
      for (const double step : {1e-3, 1.0 / 24.0, 1.0 / 6.0}) {
        const Taken taken = take_up({slack, stiffness}, step);
        ASSERT_TRUE(taken.done);
        EXPECT_NEAR(taken.load, kTaut, 0.2 * kTaut) << stiffness << " N/m, " << slack << " m, " << step << " s";
      }
}

TEST(TakeUpSlack, SlackensALoopThatIsTautAlready) {
  const Taken taken = take_up({-2e-3, 1000.0}, 1.0 / 24.0);
  ASSERT_TRUE(taken.done);
  EXPECT_NEAR(taken.load, kTaut, 0.2 * kTaut);
  EXPECT_LE(taken.most, 0.0) << "it went further out first";
}

TEST(TakeUpSlack, StandsWhereNoWayBackTakesTheLoadAway) {
  const Taken taken = take_up({0.0, 1000.0, 1.0}, 1.0 / 24.0);
  ASSERT_TRUE(taken.done);
  EXPECT_LT(taken.least, -2.9 * kRadius);
  EXPECT_GT(taken.least, -3.2 * kRadius);
}

TEST(TakeUpSlack, StandsWhereKnotsSlideUnderLess) {
  const Taken taken = take_up({1.0, 1000.0, 0.0, 2.0}, 1.0 / 24.0);
  ASSERT_TRUE(taken.done);
  EXPECT_NEAR(2.0 * taken.way, 0.3 * kRadius, 2.0 * kSpeed / 24.0);
}

}  // namespace
}  // namespace knot_utm
