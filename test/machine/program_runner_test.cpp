#include "knot_utm/machine/program_runner.hpp"

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

Record run(FakeBench bench, ProgramRunner& program) {
  Record result;
  run_test(bench, program, [&](const Command& command, const Sample& sample) {
    result.commands.push_back(command);
    result.samples.push_back(sample);
    ASSERT_LT(result.commands.size(), 100000u);
  });
  return result;
}

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
  const Record result = run(FakeBench(), program);
  for (std::size_t n = 0; n < result.commands.size(); ++n) {
    EXPECT_EQ(result.commands[n].sequence, n);
    EXPECT_EQ(result.commands[n].time, static_cast<double>(n) / 12.0);
    EXPECT_EQ(result.commands[n].read_cell, n % 4 == 0);
    EXPECT_EQ(result.commands[n].step < 0, n == 0);
  }
}

TEST(ProgramRunner, RunsThePapersPhasesInOrder) {
  ProgramRunner program(paper_program(), 3.0, 0.1, {});
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

TEST(ProgramRunner, CrossheadMovesOnlyInMountPreloadAndPull) {
  ProgramStep preload = step(Phase::kPreload, 0.001);
  preload.load = 20.0;
  ProgramRunner program({step(Phase::kTie), step(Phase::kRelease, 0.0033, 1.0), step(Phase::kMount), preload,
                         step(Phase::kBalance), pull(0.01), step(Phase::kHold, 0.0033, 2.0)},
                        3.0, 0.1, {});
  const Record result = run(FakeBench(), program);
  for (std::size_t n = 1; n < result.commands.size(); ++n) {
    const Command& command = result.commands[n];
    const double moved = command.displacement - result.commands[n - 1].displacement;
    EXPECT_NEAR(moved, command.velocity * program.period(), 1e-15);
    const bool moves =
        command.phase == Phase::kMount || command.phase == Phase::kPreload || command.phase == Phase::kPull;
    if (command.phase == Phase::kPreload) {  // which meets its load, and then balances
      EXPECT_GE(command.velocity, 0.0);
      EXPECT_LE(command.velocity, command.speed);
    } else {
      EXPECT_EQ(command.velocity, moves ? command.speed : 0.0);
    }
  }
  EXPECT_EQ(program.ended_by(), EndedBy::kProgram);
}

TEST(ProgramRunner, PullEndsAtTheFirstSampleAtOrBeyondItsExtension) {
  ProgramRunner program({step(Phase::kBalance), pull(0.01)}, 3.0, 1.0, {});
  const Record result = run(FakeBench(), program);
  const std::size_t n = result.samples.size();
  EXPECT_GE(result.samples[n - 1].extension, 0.01);
  EXPECT_LT(result.samples[n - 2].extension, 0.01);
}

TEST(ProgramRunner, HoldLastsItsDurationInWholePeriods) {
  for (const auto& [duration, commands] : {std::pair{2.0, 24}, std::pair{2.01, 25}, std::pair{0.001, 1}}) {
    ProgramRunner program({step(Phase::kHold, 0.0033, duration)}, 3.0, 0.1, {});
    EXPECT_EQ(run(FakeBench(), program).commands.size(), static_cast<std::size_t>(commands + 1)) << duration;
    EXPECT_EQ(program.ended_by(), EndedBy::kProgram);
  }
}

TEST(ProgramRunner, UntilLoadAndUntilTime) {
  ProgramStep to_load = step(Phase::kPull, 0.01);
  to_load.until.load = 5.0;
  ProgramRunner by_load({to_load}, 3.0, 0.1, {});
  EXPECT_NEAR(run(FakeBench(), by_load).samples.back().load, 5.0, 5e-3);  // kMetLoad
  EXPECT_EQ(by_load.ended_by(), EndedBy::kLoad);

  ProgramStep to_time = step(Phase::kPull, 0.01);
  to_time.until.time = 1.0;
  ProgramRunner by_time({to_time}, 3.0, 0.1, {});
  EXPECT_DOUBLE_EQ(run(FakeBench(), by_time).samples.back().time, 1.0);
  EXPECT_EQ(by_time.ended_by(), EndedBy::kProgram);
}

TEST(ProgramRunner, EndsByBreakOverloadTravelAndSolver) {
  FakeBench breaks;
  breaks.break_force = 3.0;
  ProgramRunner by_break({pull(0.1)}, 3.0, 0.1, {});
  run(breaks, by_break);
  EXPECT_EQ(by_break.ended_by(), EndedBy::kBreak);

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
    ProgramRunner program({step(Phase::kTie), step(Phase::kRelease, 0.0033, 1.0), step(Phase::kMount), pull(0.1)}, 3.0,
                          0.1, {});
    const Record result = run(bench, program);
    EXPECT_EQ(program.ended_by(), EndedBy::kUntangled);
    EXPECT_EQ(program.reason(), std::string(one.phase) + ": the knot came undone");
    EXPECT_TRUE(program.failed());
    EXPECT_LT(result.samples.back().time, one.undone_from + 3.0 * program.period()) << "the third answer says so";
  }
}

TEST(ProgramRunner, WhatComesUndoneWhilePulledIsPulledOn) {
  FakeBench bench;
  bench.undone_from = 2.5;
  ProgramRunner program({step(Phase::kTie), step(Phase::kRelease, 0.0033, 1.0), step(Phase::kMount), pull(0.01)}, 3.0,
                        0.1, {});
  run(bench, program);
  EXPECT_EQ(program.ended_by(), EndedBy::kExtension);
  EXPECT_FALSE(program.failed());
}

/// So that one may watch how the knot comes open.
TEST(ProgramRunner, AProgramThatOnlyTiesGoesOnToItsEnd) {
  FakeBench bench;
  bench.undone_from = 0.3;
  ProgramRunner program({step(Phase::kTie), step(Phase::kRelease, 0.0033, 1.0)}, 3.0, 0.1, {});
  const Record result = run(bench, program);
  EXPECT_GT(result.samples.back().time, 1.4);
  EXPECT_EQ(program.ended_by(), EndedBy::kUntangled);
  EXPECT_EQ(program.reason(), "");
  EXPECT_FALSE(program.failed());
}

TEST(ProgramRunner, EveryEndHasANameOfItsOwn) {
  for (int i = 0; i <= static_cast<int>(EndedBy::kUntangled); ++i) {
    const auto end = static_cast<EndedBy>(i);
    EXPECT_EQ(ended_by_named(ended_by_name(end)), end);
  }
  EXPECT_EQ(ended_by_named("never"), std::nullopt);
}

/// What interrupts a test comes between two commands, where it can go on.
TEST(ProgramRunner, AnInterruptedTestGoesOnAsIfItWasNot) {
  ProgramRunner whole(paper_program(), 3.0, 0.1, {}), cut(paper_program(), 3.0, 0.1, {});
  const Record unbroken = run(FakeBench(), whole);
  FakeBench bench;
  std::vector<double> forces;
  const auto observe = [&](const Command&, const Sample& sample) { forces.push_back(sample.force_upper); };
  for (std::size_t most = 10; !cut.ended(); most += 10)
    run_test(bench, cut, observe, [&] { return forces.size() >= most; });
  ASSERT_EQ(forces.size(), unbroken.samples.size());
  for (std::size_t i = 0; i < forces.size(); ++i) EXPECT_EQ(forces[i], unbroken.samples[i].force_upper);
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

TEST(ProgramRunner, GoesOnWithWhatDoesNotComeToRestAsWithWhatDoes) {
  FakeBench calm, restless;
  restless.comes_to_rest = false;
  ProgramRunner rested(paper_program(), 3.0, 0.1, {}), moving(paper_program(), 3.0, 0.1, {});
  const Record with_rest = run(calm, rested), without = run(restless, moving);
  EXPECT_EQ(moving.ended_by(), EndedBy::kExtension);
  EXPECT_EQ(without.commands.size(), with_rest.commands.size());
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

TEST(ProgramRunner, TakesNoAnswerToAnotherCommand) {
  ProgramRunner program({pull(0.1)}, 3.0, 0.1, {});
  Sample sample;
  sample.sequence = 7;
  EXPECT_THROW(program.next(sample), std::invalid_argument);
}

TEST(ProgramRunner, ProgressGrowsFromZeroToOne) {
  ProgramRunner program(paper_program(), 3.0, 0.1, {});
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

ProgramStep preload(double load, bool balance = true) {
  ProgramStep out = step(Phase::kPreload, 0.001);
  out.load = load;
  out.balance = balance;
  return out;
}

TEST(ProgramRunner, PreloadMeetsItsLoadAndBalancesStandingStill) {
  ProgramRunner program({preload(2.0), pull(0.01)}, 3.0, 0.1, {});
  const Record result = run(FakeBench(), program);
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

/// The next step begins in the new zero.
TEST(ProgramRunner, WhatFollowsAPreloadBeginsAtZero) {
  ProgramStep hold = step(Phase::kHold, 0.0033, 2.0), by_load = step(Phase::kPull);
  hold.hold_load = true;
  by_load.load_rate = 1.0;
  by_load.until.load = 3.0;
  ProgramStep cycle = step(Phase::kCycle);
  cycle.extension_turns = TurningPoints{0.0, 0.001};
  cycle.cycles = 1;
  ProgramRunner program({preload(2.0), hold, by_load, step(Phase::kBalance), cycle}, 3.0, 0.1, {});
  const Record result = run(FakeBench(), program);
  double begin = 0.0;
  for (std::size_t n = 1; n < result.samples.size(); ++n) {
    const Sample& sample = result.samples[n];
    if (sample.phase == Phase::kHold) {
      EXPECT_NEAR(sample.load, 0.0, 1e-12);
      begin = sample.time;
    }
    if (sample.phase == Phase::kPull) {
      EXPECT_LE(sample.load, sample.time - begin + 1e-9);
    }
    if (sample.phase == Phase::kCycle) {
      EXPECT_GE(sample.extension, -1e-12);
    }
  }
}

TEST(ProgramRunner, ABalanceByTheOperatorMovesNoHeldLoadAndIsNoBreak) {
  ProgramStep hold = step(Phase::kHold, 0.0033, 5.0);
  hold.hold_load = true;
  ProgramRunner::Limits limits;
  limits.breaks.sharp_drop = 0.5;
  limits.breaks.fraction_of_peak = 0.5;
  ProgramRunner program({pull(0.01), hold}, 3.0, 0.1, limits);
  FakeBench bench;
  double held = 0.0;
  bool balanced = false;
  run_test(bench, program, [&](const Command& command, const Sample& sample) {
    if (command.phase != Phase::kHold) {
      held = sample.force_upper;
      return;
    }
    EXPECT_NEAR(sample.force_upper, held, 1e-9);
    if (!balanced) program.balance();
    balanced = true;
  });
  EXPECT_EQ(program.ended_by(), EndedBy::kProgram) << program.reason();
}

TEST(ProgramRunner, ErrorsOfTheCellLeadNothing) {
  struct WrongCell : FakeBench {
    Sample respond(const Command& command) {
      Sample sample = FakeBench::respond(command);
      if (command.read_cell) sample.load = 1.1 * sample.load + 0.3;
      return sample;
    }
  };
  ProgramStep hold = step(Phase::kHold, 0.0033, 3.0);
  hold.hold_load = true;
  hold.held_load = 7.0;
  ProgramRunner program({preload(2.0, false), hold}, 3.0, 0.1, {});
  WrongCell bench;
  double last = 0.0;
  run_test(bench, program, [&](const Command&, const Sample& sample) { last = sample.force_upper; });
  EXPECT_NEAR(last, 7.0, 1e-9);
}

TEST(ProgramRunner, ARateOfLoadGoesOnFromWhereTheCrossheadCouldNotKeepUp) {
  struct SlackThenStiff : FakeBench {
    Sample respond(const Command& command) {
      FakeBench::respond(command);
      Sample sample = substeps.back();
      sample.force_upper = sample.load = 1000.0 * std::max(0.0, sample.displacement - 0.01);
      return sample;
    }
  };
  ProgramStep by_load = step(Phase::kPull, 0.0033);
  by_load.load_rate = 1.0;
  by_load.until.load = 5.0;
  ProgramRunner program({by_load}, 3.0, 0.1, {});
  SlackThenStiff bench;
  double before = 0.0, steepest = 0.0;
  run_test(bench, program, [&](const Command&, const Sample& sample) {
    steepest = std::max(steepest, (sample.force_upper - before) / program.period());
    before = sample.force_upper;
  });
  // The command in which the slack ends is led as if it went on: what the crosshead moves in one period.
  EXPECT_LE(steepest, 1000.0 * 0.0033 + 1e-9);
  EXPECT_NEAR(before, 5.0, 5e-3);
}

TEST(ProgramRunner, PullsAtARateOfLoad) {
  ProgramStep by_load = step(Phase::kPull, 0.01);
  by_load.load_rate = 2.0;
  by_load.until.load = 10.0;
  ProgramRunner program({by_load}, 3.0, 0.1, {});
  const Record result = run(FakeBench(), program);
  // The first command finds out how stiff the spring is.
  for (std::size_t n = 2; n < result.samples.size(); ++n)
    EXPECT_NEAR(result.samples[n].load, 2.0 * result.samples[n].time, 1e-9);
  EXPECT_EQ(program.ended_by(), EndedBy::kLoad);
}

TEST(ProgramRunner, HoldsALoad) {
  ProgramStep hold = step(Phase::kHold, 0.01, 5.0);
  hold.hold_load = true;
  hold.held_load = 7.0;
  ProgramRunner to_another({pull(0.01), hold}, 3.0, 0.1, {});
  EXPECT_NEAR(run(FakeBench(), to_another).samples.back().load, 7.0, 1e-9);
  hold.held_load.reset();
  ProgramRunner as_it_is({pull(0.01), hold}, 3.0, 0.1, {});
  const Record result = run(FakeBench(), as_it_is);
  for (const Sample& sample : result.samples)
    if (sample.phase == Phase::kHold) {
      EXPECT_NEAR(sample.load, 1000.0 * 0.01, 0.5);
    }
  EXPECT_EQ(as_it_is.ended_by(), EndedBy::kProgram);
}

TEST(ProgramRunner, CyclesBetweenExtensionsThatItMeets) {
  ProgramStep cycle = step(Phase::kCycle, 0.0033);
  cycle.extension_turns = TurningPoints{0.001, 0.004};
  cycle.cycles = 3;
  ProgramRunner program({step(Phase::kBalance), cycle}, 3.0, 0.1, {});
  const Record result = run(FakeBench(), program);
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

TEST(ProgramRunner, CyclesBetweenLoadsByCountOrTime) {
  ProgramStep cycle = step(Phase::kCycle, 0.0033);
  cycle.load_turns = TurningPoints{1.0, 4.0};
  cycle.cycles = 2;
  ProgramRunner by_count({cycle}, 3.0, 0.1, {});
  const Record counted = run(FakeBench(), by_count);
  constexpr double kMet = 3e-3;  // kMetLoad of the range
  double highest = 0.0;
  for (const Sample& sample : counted.samples) highest = std::max(highest, sample.load);
  EXPECT_NEAR(highest, 4.0, kMet);
  EXPECT_NEAR(counted.samples.back().load, 1.0, kMet);

  cycle.cycles = 0;
  cycle.until.time = 10.0;
  ProgramRunner by_time({cycle}, 3.0, 0.1, {});
  EXPECT_DOUBLE_EQ(run(FakeBench(), by_time).samples.back().time, 10.0);
  EXPECT_EQ(by_time.ended_by(), EndedBy::kProgram);
}

TEST(ProgramRunner, ReturnsToAnExtensionOrALoad) {
  ProgramRunner home({step(Phase::kBalance), pull(0.01), step(Phase::kReturn)}, 3.0, 0.1, {});
  EXPECT_NEAR(run(FakeBench(), home).samples.back().extension, 0.0, 1e-12);
  EXPECT_EQ(home.ended_by(), EndedBy::kExtension);

  ProgramStep unload = step(Phase::kReturn);
  unload.until.load = 3.0;
  ProgramRunner to_load({step(Phase::kBalance), pull(0.01), unload}, 3.0, 0.1, {});
  EXPECT_NEAR(run(FakeBench(), to_load).samples.back().load, 3.0, 1e-3 * 10.3);  // kMetLoad of where it began
  EXPECT_EQ(to_load.ended_by(), EndedBy::kLoad);
}

TEST(ProgramRunner, FollowsARecordFromWhereItStands) {
  ProgramStep follow = step(Phase::kFollow);
  follow.recorded = {{0.0, 0.5}, {1.0, 0.502}, {1.5, 0.501}, {3.0, 0.507}};
  ProgramRunner program({pull(0.01), follow}, 3.0, 0.1, {});
  const Record result = run(FakeBench(), program);
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

TEST(ProgramRunner, ATimeLimitEndsIt) {
  ProgramRunner::Limits limits;
  limits.time = 1.0;
  ProgramRunner program({pull(0.1)}, 3.0, 0.1, limits);
  EXPECT_DOUBLE_EQ(run(FakeBench(), program).samples.back().time, 1.0);
  EXPECT_EQ(program.ended_by(), EndedBy::kTime);
  EXPECT_THAT(program.reason(), HasSubstr("time is over"));
}

TEST(ProgramRunner, ADropThatIsABreakEndsIt) {
  FakeBench weak;
  weak.weak_from = 0.008;
  ProgramRunner::Limits limits;
  limits.breaks.fraction_of_peak = 0.4;
  limits.breaks.arming_load = 5.0;
  ProgramRunner program({pull(0.1)}, 3.0, 0.1, limits);
  const Record result = run(weak, program);
  EXPECT_EQ(program.ended_by(), EndedBy::kBreak);
  EXPECT_THAT(program.reason(), HasSubstr("the load fell"));
  EXPECT_NEAR(result.samples.back().displacement, 0.008, 0.0033 * program.period());

  // On the way in of a cycle loads fall as they should.
  ProgramStep cycle = step(Phase::kCycle, 0.0033);
  cycle.extension_turns = TurningPoints{0.0, 0.007};
  cycle.cycles = 2;
  ProgramRunner cycles({step(Phase::kBalance), cycle}, 3.0, 0.1, limits);
  run(weak, cycles);
  EXPECT_EQ(cycles.ended_by(), EndedBy::kProgram);
}

TEST(ProgramRunner, AReturnNeverMovesOutwards) {
  ProgramStep home = step(Phase::kReturn);
  home.return_extension = 0.02;
  ProgramRunner program({step(Phase::kBalance), pull(0.01), home}, 3.0, 0.1, {});
  const Record result = run(FakeBench(), program);
  EXPECT_NEAR(result.samples.back().displacement, 0.01, 0.0033 * program.period());
  for (const Command& command : result.commands)
    if (command.phase == Phase::kReturn) {
      EXPECT_EQ(command.velocity, 0.0);
    }
}

TEST(ProgramRunner, GripsThatMeetEndIt) {
  ProgramStep home = step(Phase::kReturn, 0.01);
  home.return_extension = -1.0;
  ProgramRunner::Limits limits;
  limits.least_distance = 0.1;  // from 0.25 m on
  ProgramRunner program({home}, 3.0, 0.1, limits);
  EXPECT_NEAR(run(FakeBench(), program).samples.back().end_to_end, 0.1, 0.01 * program.period());
  EXPECT_EQ(program.ended_by(), EndedBy::kTravel);
  EXPECT_THAT(program.reason(), HasSubstr("the grips meet"));
}

TEST(ProgramRunner, UnloadingAsProgrammedIsNoBreak) {
  ProgramStep hold = step(Phase::kHold, 0.01, 5.0);
  hold.hold_load = true;
  hold.held_load = 2.0;
  ProgramRunner::Limits limits;
  limits.breaks.fraction_of_peak = limits.breaks.sharp_drop = limits.breaks.drop = 0.5;
  ProgramRunner program({pull(0.01), hold}, 3.0, 0.1, limits);
  EXPECT_NEAR(run(FakeBench(), program).samples.back().load, 2.0, 1e-9);
  EXPECT_EQ(program.ended_by(), EndedBy::kProgram) << program.reason();
}

/// A frame of which half of every way remains.
TEST(ProgramRunner, MeetsExtensionsOnACompliantFrameAtSpeed) {
  struct Compliant : FakeBench {
    Sample respond(const Command& command) {
      Sample sample = FakeBench::respond(command);
      sample.extension *= 0.5;
      return sample;
    }
  };
  ProgramStep cycle = step(Phase::kCycle, 0.001);
  cycle.extension_turns = TurningPoints{0.0, 0.002};
  cycle.cycles = 2;
  ProgramRunner program({cycle}, 3.0, 0.1, {});
  Compliant bench;
  double highest = 0.0, time = 0.0;
  run_test(bench, program, [&](const Command&, const Sample& sample) {
    highest = std::max(highest, sample.extension);
    time = sample.time;
  });
  EXPECT_NEAR(highest, 0.002, 1e-3 * 0.001 * program.period());
  EXPECT_NEAR(time, 4 * 0.002 / (0.5 * 0.001), 8 * program.period());
}

TEST(ProgramRunner, ALostBenchCountsBeforeAStopThatWasAskedFor) {
  ProgramRunner program({pull(0.1)}, 3.0, 0.1, {});
  program.stop();
  program.fail("it died");
  EXPECT_EQ(program.ended_by(), EndedBy::kSolver);
  EXPECT_EQ(program.reason(), "it died");
}

}  // namespace
}  // namespace knot_utm
