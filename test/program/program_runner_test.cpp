#include "knot_utm/program/program_runner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "program/programs.hpp"
#include "rod/materials.hpp"

namespace knot_utm {
namespace {

using testing::HasSubstr;

using namespace programs;

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
  const auto ended = [](const FakeBench& bench, const ProgramRunner::Limits& limits) {
    ProgramRunner program({pull(0.1)}, 3.0, 0.1, limits);
    run(bench, program);
    return program;
  };
  FakeBench breaks, fails;
  breaks.break_force = 3.0;
  fails.fail_time = 1.0;
  ProgramRunner::Limits load, travel;
  load.load = 3.0;
  travel.travel = 0.02;
  EXPECT_EQ(ended(breaks, {}).ended_by(), EndedBy::kBreak);
  EXPECT_FALSE(ended(breaks, {}).failed());
  EXPECT_EQ(ended({}, load).ended_by(), EndedBy::kLoad);
  EXPECT_THAT(ended({}, load).reason(), HasSubstr("capacity"));
  EXPECT_EQ(ended({}, travel).ended_by(), EndedBy::kTravel);
  EXPECT_EQ(ended(fails, {}).ended_by(), EndedBy::kSolver);
  EXPECT_THAT(ended(fails, {}).reason(), HasSubstr("converged"));
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
  for (const double force : {20.1, -20.1, 20.0, -20.0, 19.9, -19.9}) {
    ProgramRunner program({pull(0.1)}, 3.0, 0.1, limits);
    Sample sample;
    sample.force_upper = force;
    sample.load = force - 10.0 * (force > 0.0 ? 1.0 : -1.0);  // balanced at half of it
    program.next(sample);
    EXPECT_EQ(program.ended_by(), std::abs(force) >= 20.0 ? EndedBy::kLoad : EndedBy::kNotYet) << force;
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

constexpr double kLength = 0.25, kEdge = 0.005;
constexpr const char* kFromFile = "a file of config/knots/";
constexpr double kTwisted = kLength + kEdge;  // clamps hold the frames of edges, each of which lies in one

TwistStep twist(double turns, double rate = 1.0) {
  TwistStep out;
  out.turns = turns;
  out.rate = rate;
  return out;
}

TestingMachine clamped_rod() {
  SpecimenOptions specimen;
  specimen.knot = knot_named("straight");
  specimen.length = kLength;
  specimen.edge_length = kEdge;
  MachineOptions machine;
  machine.grips = GripKind::kClamps;
  PhysicsOptions physics;
  physics.twist = TwistMode::kOn;
  return {specimen, nylon(), machine, physics};
}

/// Two straight strands of a solid rod, half their length and touching, one running up and one down.
TestingMachine clamped_pair() {
  KnotDrawing pair;
  pair.name = "pair";
  pair.strands = {{{"lower_1", "upper_1"}, {{1, 0, -10}, {1, 0, 0}, {1, 0, 10}}},
                  {{"upper_2", "lower_2"}, {{-1, 0, 10}, {-1, 0, 0}, {-1, 0, -10}}}};
  pair.lower = {"lower_1", "lower_2"};
  pair.upper = {"upper_1", "upper_2"};
  SpecimenOptions specimen;
  specimen.knot = knot_named(kFromFile);
  specimen.drawing = std::make_shared<const KnotDrawing>(pair);
  Material solid = nylon();
  solid.stretching_stiffness = 10.0 * solid.bending_stiffness / (solid.radius * solid.radius);
  solid.friction_coefficient = 0.0;
  specimen.end_to_end = 80.0 * solid.radius;
  specimen.edge_length = solid.radius;
  MachineOptions machine;
  machine.grips = GripKind::kClamps;
  return {specimen, solid, machine, PhysicsOptions()};
}

/// All answers to a pull by `extension` and then these steps.
std::vector<Sample> answers(double extension, Program steps, TestingMachine machine = clamped_rod()) {
  steps.insert(steps.begin(), pull(extension, 1e-5));
  ProgramRunner program(steps, 6.0, 1.0, {});
  const std::vector<Sample> out = run(std::move(machine), program).samples;
  EXPECT_FALSE(program.failed()) << program.reason();
  return out;
}

/// M = k_t phi/L, and the energy that the clamp gives is stored.
TEST(TwistStep, AStraightRodBearsItsTorsionalStiffnessTimesItsRateOfTwist) {
  const std::vector<Sample> all = answers(1e-5, {twist(3.0), twist(-4.5)});
  double largest = 0.0, work = 0.0;
  for (const Sample& sample : all) {
    // The rod at rest: what its inertia adds while it turns evenly is less than the residual of a spin.
    EXPECT_NEAR(sample.torque, nylon().twisting_stiffness * sample.turn / kTwisted, 1e-8);
    largest = std::max(largest, sample.turn);
    if (sample.turn == 0.0) work = sample.grip_work;
  }
  EXPECT_NEAR(largest, 6.0 * M_PI, 1e-9);
  EXPECT_NEAR(all.back().turn, -3.0 * M_PI, 1e-9);
  EXPECT_NEAR(all.back().grip_work - work, all.back().twisting_energy, 1e-3 * all.back().twisting_energy);
}

TEST(TwistStep, EndsByItsTurnsOrEarlierByItsTorque) {
  TwistStep until = twist(-40.0);
  until.torque = 1e-3;
  const std::vector<Sample> all = answers(1e-5, {until});
  const double turn = 1e-3 * kTwisted / nylon().twisting_stiffness;
  EXPECT_LE(all.back().turn, -turn);
  EXPECT_GT(all.back().turn, -turn - 2.0 * M_PI / 6.0);  // the turn in one command
}

/// The frames turn and the strands' ends go around: what both take is stored, as nothing else moves and nothing rubs.
TEST(TwistStep, TheWorkOfItsTorqueOnTwoStrandsIsStoredInThem) {
  const std::vector<Sample> all = answers(1e-5, {twist(4.0)}, clamped_pair());
  const auto stored = [](const Sample& s) {
    return s.stretching_energy + s.bending_energy + s.twisting_energy + s.contact_energy;
  };
  double work = 0.0;
  const Sample* before = nullptr;
  for (const Sample& sample : all) {
    if (before && std::isfinite(before->torque))
      work += 0.5 * (before->torque + sample.torque) * (sample.turn - before->turn);
    before = &sample;
  }
  const double gained = stored(all.back()) - stored(all.front());
  EXPECT_NEAR(all.back().turn, 8.0 * M_PI, 1e-9);
  // Frames alone store less: the strands also bend, and stretch as they go around.
  EXPECT_GT(gained, 1.2 * all.back().twisting_energy);
  EXPECT_NEAR(work, gained, 0.01 * gained);  // the trapezoidal rule and drag
}

/// Stops where a machine would (Command::stop_load).
struct StoppingBench : FakeBench {
  Sample respond(Command command) {
    const double sense = command.velocity < 0.0 ? -1.0 : 1.0, stop = (command.stop_load + offset) / stiffness;
    if (sense * (command.displacement - stop) > 0.0) command.displacement = stop;
    const Sample sample = FakeBench::respond(command);
    offset = sample.balance_offset;
    return sample;
  }

  double offset = 0.0;  // [N]
};

TEST(ProgramRunner, EveryCommandThatMovesSaysAtWhichLoadItStops) {
  ProgramRunner::Limits limits;
  limits.load = 5.0;
  auto to_load = pull(0.01);
  to_load.until.load = 3.0;
  auto back = step<ReturnStep>(0.0033);
  back.load = 1.0;
  ProgramRunner program({BalanceStep(), to_load, back, pull(1.0)}, 3.0, 0.1, limits);
  const Answered result = run(StoppingBench(), program);
  for (const Command& command : result.commands) {
    const double expected = command.velocity == 0.0 ? Sample::kNone : std::array{0.0, 3.0, 1.0, 5.0}[command.step];
    EXPECT_TRUE(command.stop_load == expected || std::isnan(expected)) << command.sequence;
  }
  EXPECT_EQ(program.ended_by(), EndedBy::kLoad);
  EXPECT_EQ(result.samples.back().load, 5.0);
}

/// Commands that the crosshead of a stiff specimen does not finish: the next ones go on from where it stands.
TEST(ProgramRunner, GoesOnFromWhereTheCrossheadStopped) {
  auto cycle = step<CycleStep>(0.0033);
  cycle.load = fields::LowHigh{10.0, 100.0};
  cycle.cycles = 2;
  StoppingBench bench;
  bench.stiffness = 1e6;
  ProgramRunner program({cycle}, 3.0, 0.1, {});
  const Answered result = run(bench, program);
  EXPECT_EQ(program.ended_by(), EndedBy::kProgram);
  double least = 1e9, most = 0.0;
  for (std::size_t i = result.samples.size() / 2; i < result.samples.size(); ++i) {
    least = std::min(least, result.samples[i].load);
    most = std::max(most, result.samples[i].load);
  }
  EXPECT_NEAR(least, 10.0, 0.09);
  EXPECT_NEAR(most, 100.0, 0.09);
}

TEST(ProgramRunner, LedByTheOperatorItPreparesTheSpecimenThenGoesThereAndWaits) {
  ProgramRunner program(paper_program(), 3.0, 0.1, {});
  program.lead({0.0, 20.0, 0.001});
  const std::vector<Sample> samples = run(StoppingBench(), program).samples;
  EXPECT_EQ(program.led_by(), EndedBy::kLoad);
  EXPECT_NEAR(samples.back().load, 20.0, 0.02);
  std::vector<Phase> phases;
  for (const Sample& sample : samples)
    if (phases.empty() || phases.back() != sample.phase) phases.push_back(sample.phase);
  EXPECT_EQ(phases,
            (std::vector{Phase::kIdle, Phase::kTie, Phase::kRelease, Phase::kMount, Phase::kBalance, Phase::kPull}));
  const Command there = program.last();
  EXPECT_EQ(program.next(samples.back()).sequence, there.sequence);  // nothing to do
  program.stop();
  EXPECT_EQ(program.ended_by(), EndedBy::kOperator);
}

TEST(ProgramRunner, LedOutAndInItGivesUpWhatItDidAndStandsWhereItIsToldTo) {
  ProgramRunner program({pull(0.1)}, 3.0, 0.1, {});
  StoppingBench bench;
  Command command = program.last();
  const auto go = [&](const auto& until) {
    Sample sample;
    for (int i = 0; i < 1000 && !program.waits() && !until(); ++i) {
      sample = bench.respond(command);
      command = program.next(sample);
    }
    return sample;
  };
  const auto forever = [] { return false; };
  go([&] { return command.displacement > 0.01; });
  program.lead({0.02, 1e6, 0.0});  // an extension, before that load
  EXPECT_NEAR(go(forever).extension, 0.02, 0.0033 * program.period());
  EXPECT_EQ(program.led_by(), EndedBy::kExtension);
  program.lead({0.0, 5.0, 0.01});  // a load, inwards
  command = program.next(bench.respond(command));
  EXPECT_LT(command.velocity, 0.0);
  EXPECT_NEAR(go(forever).load, 5.0, 0.03);
  program.lead({});  // back
  command = program.next(bench.respond(command));
  EXPECT_NEAR(go(forever).load, 0.0, 0.01);
  program.lead({0.1, 0.0, 0.0});
  command = program.next(bench.respond(command));
  EXPECT_GT(command.velocity, 0.0);
  EXPECT_TRUE(program.stand());
  const double place = go(forever).displacement;
  EXPECT_EQ(program.led_by(), EndedBy::kOperator);
  EXPECT_LT(place, 0.1);
  EXPECT_FALSE(program.ended());
}

TEST(ProgramRunner, AMoveThatIsTakenBackBeforeItBeginsChangesNothing) {
  ProgramRunner program(paper_program(), 3.0, 0.1, {}), usual(paper_program(), 3.0, 0.1, {});
  program.lead({0.0, 20.0, 0.0});
  EXPECT_FALSE(program.stand());
  EXPECT_EQ(run(StoppingBench(), program).samples.size(), run(StoppingBench(), usual).samples.size());
  EXPECT_EQ(program.ended_by(), EndedBy::kExtension);
}

}  // namespace
}  // namespace knot_utm
