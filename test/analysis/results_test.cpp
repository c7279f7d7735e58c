#include "knot_utm/analysis/results.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "analysis/made_up_curve.hpp"

namespace knot_utm {
namespace {

using made_up::Curve;
using made_up::on_rollers;

/// At a displacement [m], which is the extension too, under a force [N].
Sample reading(Phase phase, double displacement, double force) {
  Sample out;
  out.phase = phase;
  out.displacement = out.extension = displacement;
  out.force_upper = out.force_lower = force;
  out.end_to_end = 0.25 + displacement;
  return out;
}

TEST(Results, AKnotThatJumpsBeforeTheLockIsFastWhatSnapsBehindItIsNot) {
  Curve curve;
  curve.lock = 0.08;
  std::vector<Sample> samples = curve.samples();
  const auto at = [&](double extension) -> Sample& {
    return samples[static_cast<std::size_t>(std::lround(extension / curve.step))];
  };
  at(0.1).fastest_node = 1.5;  // knots that are pressed together snap at kN loads
  EXPECT_EQ(on_rollers(samples, EndedBy::kExtension).fastest_node, 0.0);
  at(0.02).fastest_node = 0.3;
  EXPECT_EQ(on_rollers(samples, EndedBy::kExtension).fastest_node, 0.3);
}

TEST(Results, SayWhereTheKnotsFirstTouchEachOtherAndARoller) {
  std::vector<Sample> samples = Curve().samples();
  for (Sample& sample : samples) {
    sample.knots_force = sample.extension > 0.07 ? 0.1 : 0.0;
    // A tail brushes along the roller, and bears on it later.
    sample.knot_on_roller = sample.force_upper * (sample.extension > 0.09 ? 0.06 : 0.04);
  }
  samples.front().phase = Phase::kMount;
  samples.front().knots_force = 1.0;  // does not count: it is not pulled
  const Results results = on_rollers(samples, EndedBy::kExtension);
  ASSERT_TRUE(results.first_contact_extension && results.roller_touched_at);
  EXPECT_NEAR(*results.first_contact_extension, 0.07, 1.2e-3);
  EXPECT_NEAR(*results.roller_touched_at, 0.09, 1.2e-3);
}

/// A pull in steps of a second, of a knot that is read at every second of them, as answers are.
std::vector<Sample> read_pull(const std::vector<double>& forces) {
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    Sample sample;
    sample.phase = i == 0 ? Phase::kRelease : Phase::kPull;
    sample.time = static_cast<double>(i);
    sample.extension = 1e-3 * sample.time;
    sample.force_upper = sample.force_lower = sample.load = forces[i];
    samples.push_back(sample);
  }
  return samples;
}

TEST(Results, WhatIsReadOfAKnotIsThatOfThePullWhereItIsKnown) {
  std::vector<Sample> samples = read_pull({0, 0, 1, 2, 3, 4, 5});
  constexpr double kUnknown = PerKnot::kUnknown;
  samples[0].knot_readings = {0.5, 0.7, 0.9};
  samples[1].knot_readings = {0.4, kUnknown, kUnknown};
  samples[3].knot_readings = {0.3, 0.2, kUnknown};
  samples[5].knot_readings = {kUnknown, 0.1, kUnknown};
  const Results results = on_rollers(samples, EndedBy::kExtension);
  ASSERT_EQ(results.knot_reading_begin.size(), 3u);
  EXPECT_EQ(results.knot_reading_begin[0], 0.4);
  EXPECT_EQ(results.knot_reading_end[0], 0.3);
  EXPECT_EQ(results.knot_reading_begin[1], 0.2);
  EXPECT_EQ(results.knot_reading_end[1], 0.1);
  EXPECT_TRUE(std::isnan(results.knot_reading_begin[2]) && std::isnan(results.knot_reading_end[2]));
}

/// A rope that lost its knot flies about and touches itself again; before the largest load it may be loose.
TEST(Results, ATailHasSlippedAsFarAsItWasInTheKnot) {
  std::vector<Sample> samples = read_pull({0, 1, 0.5, 2, 5, 4, 0, 0, 0});
  const double lengths[] = {0.1, 0.1, PerKnot::kUnknown, 0.09, 0.08, 0.03, PerKnot::kUnknown, 0.3, 0.2};
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i].tail_length = {lengths[i]};
  EXPECT_NEAR(on_rollers(samples, EndedBy::kExtension).tail_slip[0], 0.07, 1e-15);
  samples[5].tail_length = {0.005};
  samples[6].tail_length = {0.002};  // and out of the knot
  EXPECT_NEAR(on_rollers(samples, EndedBy::kExtension).tail_slip[0], 0.098, 1e-15);
}

/// The load of an overhand that inverts, its stored energy and the work of the grips, as config/overhand.yaml with
/// three turns and mu = 0.1 has them: it rises, falls by half at once, and rises again.
TEST(Results, AnOverhandThatInvertsSnaps) {
  const auto pulled = [](double given_up, double end) {
    std::vector<Sample> samples;
    double work = 0.0;
    for (int i = 0; i * 1e-3 < end; ++i) {
      const double s = i * 1e-3;
      Sample sample;
      sample.phase = Phase::kPull;
      sample.time = s / 6e-3;
      sample.extension = s;
      const bool behind = s > 0.16;
      sample.force_upper = sample.force_lower = sample.load = 0.03 + 0.5 * s - (behind ? 0.05 : 0.0);
      work += 1e-3 * sample.force_upper;
      sample.grip_work = work;
      sample.bending_energy = 1.5e-3 + 0.5 * work - (behind ? given_up : 0.0);
      samples.push_back(sample);
    }
    return on_rollers(samples, EndedBy::kExtension);
  };
  for (const double end : {0.17, 0.3}) {
    const Results results = pulled(1e-3, end);
    ASSERT_TRUE(results.snap_extension && results.snap_drop) << end;
    EXPECT_NEAR(*results.snap_extension, 0.16, 1.1e-3);
    EXPECT_NEAR(*results.snap_drop, 0.05, 1e-3);
  }
  EXPECT_FALSE(pulled(0.0, 0.3).snap_extension) << "strands that stick and slip keep what the rod stores";
  EXPECT_FALSE(pulled(0.1, 0.3).snap_extension) << "what was stored before the pull is a drawn shape's";
}

/// Of a loop whose knots came nearer to each other by a tenth as it was mounted, and bore this much then [N].
Results of_knots_that_moved(double mounted, const Curve& curve, KnotType type = KnotType::kKept) {
  std::vector<Sample> samples = curve.samples();
  for (Sample& sample : samples) sample.knot_type = type;
  std::vector<Sample> before(2, samples.front());
  before[0].phase = Phase::kRelease;
  before[0].knot_type = KnotType::kKept;
  before[0].knot_distance *= 1.1;
  before[1].phase = Phase::kMount;
  before[1].force_upper = mounted;
  for (std::size_t i = 0; i < 2; ++i) before[i].time -= 2.0 - static_cast<double>(i);
  samples.insert(samples.begin(), before.begin(), before.end());
  return on_rollers(samples, EndedBy::kExtension);
}

/// As behind a jump: what is pulled is not the knot that was tied.
TEST(Results, AKnotThatOpenedAsTheLoopWasMountedAndBearsNoMoreHasNoReadings) {
  const double largest = on_rollers(Curve().samples(), EndedBy::kExtension).true_peak_force.value_or(0.0);
  const Results results = of_knots_that_moved(1.01 * largest, Curve());
  ASSERT_TRUE(results.opened_when_mounted);
  EXPECT_EQ(results.motion_pattern, MotionPattern::kUntangling) << "one event, one word";
  EXPECT_FALSE(results.untangled_at);
  EXPECT_FALSE(results.curve.plateau_force || results.true_plateau_force || results.curve.lock_extension_by_load);
  EXPECT_FALSE(results.lock_extension || results.curve.locked_stiffness);
  EXPECT_NE(results.curve.no_plateau.find("opened as the loop was mounted"), std::string::npos);
}

TEST(Results, KnotsThatMovedAsTheLoopWasMountedAndThenBearMoreAreReadAsOthersAre) {
  const Results moved = of_knots_that_moved(10.0, Curve()), others = on_rollers(Curve().samples(), EndedBy::kExtension);
  ASSERT_TRUE(moved.opened_when_mounted && others.lock_extension);
  EXPECT_EQ(moved.motion_pattern, MotionPattern::kSliding);
  EXPECT_EQ(moved.lock_extension, others.lock_extension);
  EXPECT_EQ(moved.true_plateau_force, others.true_plateau_force);
  EXPECT_EQ(moved.curve.locked_stiffness, others.curve.locked_stiffness);
  EXPECT_EQ(of_knots_that_moved(10.0, Curve(), KnotType::kCrossed).motion_pattern, MotionPattern::kUntangling);
  Curve wide;  // open knots bear a little, without sliding
  wide.lock = 0.0;
  EXPECT_EQ(of_knots_that_moved(10.0, wide).motion_pattern, MotionPattern::kUntangling);
}

/// A spring that is pulled in three coarse steps, breaks, and is balanced where it begins.
TEST(Results, WhatIsReadOffThePullBeginsWhereThePullDoes) {
  std::vector<Sample> samples = {reading(Phase::kBalance, 0.0, 2.0), reading(Phase::kPull, 0.01, 7.0),
                                 reading(Phase::kPull, 0.02, 12.0), reading(Phase::kPull, 0.03, 17.0)};
  Results results = on_rollers(samples, EndedBy::kExtension);
  EXPECT_NEAR(*results.energy_to_peak, 0.03 * (2.0 + 17.0) / 2.0, 1e-12);
  EXPECT_FALSE(results.energy_to_break);
  EXPECT_NEAR(*results.secant_stiffness, 500.0, 1e-9);
  EXPECT_NEAR(*results.tangent_stiffness, 500.0, 1e-9);
  EXPECT_FALSE(results.chord_stiffness) << "it never was as low as a tenth of the peak";
  EXPECT_FALSE(results.relaxation);
  samples.back().status = BenchStatus::kBroken;
  results = on_rollers(samples, EndedBy::kBreak);
  EXPECT_DOUBLE_EQ(*results.energy_to_break, *results.energy_to_peak);
}

/// A spring of 500 N/m: pre-loaded to 5 N and balanced there with the first command of the pull, as a program does.
TEST(Results, ABalanceBehindThePreloadIsTheOriginOfThePull) {
  const auto sample = [](Phase phase, double displacement, double extension) {
    Sample out = reading(phase, displacement, 500.0 * displacement);
    out.extension = extension;
    out.balance_offset = phase == Phase::kPreload || phase == Phase::kReturn ? 0.0 : 5.0;
    return out;
  };
  for (const double way_back : {0.0, 0.02}) {  // a return before the pre-load leaves another s behind
    std::vector<Sample> samples = {sample(Phase::kReturn, -way_back, -way_back),
                                   sample(Phase::kPreload, 0.01, 0.01 + way_back), sample(Phase::kPull, 0.012, 0.002),
                                   sample(Phase::kPull, 0.03, 0.02)};
    samples.back().status = BenchStatus::kBroken;
    const Results results = on_rollers(samples, EndedBy::kBreak);
    EXPECT_NEAR(*results.energy_to_break, 0.02 * (5.0 + 15.0) / 2.0, 1e-12);
    EXPECT_NEAR(*results.energy_to_peak, *results.energy_to_break, 1e-12);
    EXPECT_NEAR(*results.secant_stiffness, 500.0, 1e-9);
    EXPECT_NEAR(*results.tangent_stiffness, 500.0, 1e-9);
  }
  // Of cycles too: out and back once, around 2 N of friction.
  std::vector<Sample> cycling = {sample(Phase::kPreload, 0.01, 0.01), sample(Phase::kCycle, 0.02, 0.01),
                                 sample(Phase::kCycle, 0.02, 0.01), sample(Phase::kCycle, 0.01, 0.0)};
  cycling[2].force_upper -= 2.0;
  cycling[3].force_upper -= 2.0;
  const Results results = on_rollers(cycling, EndedBy::kProgram);
  EXPECT_EQ(results.cycles, 1u);
  EXPECT_NEAR(*results.hysteresis, 2.0 * 0.01, 1e-12);
}

TEST(Results, ARodThatPartsWhereNothingPullsHasABreakToo) {
  // Held at a displacement, it parts and its end recoils.
  std::vector<Sample> held = {reading(Phase::kBalance, 0.0, 0.0), reading(Phase::kPull, 0.01, 100.0),
                              reading(Phase::kHold, 0.01, 90.0), reading(Phase::kHold, 0.01, 110.0),
                              reading(Phase::kHold, 0.01, -30.0)};
  held[3].status = held[4].status = BenchStatus::kBroken;
  held[4].max_penetration = 9.0;
  Results results = on_rollers(held, EndedBy::kBreak);
  EXPECT_EQ(results.break_extension, 0.01);
  EXPECT_EQ(results.true_peak_force, 110.0);
  EXPECT_NEAR(*results.energy_to_break, 0.5, 1e-12);
  EXPECT_EQ(results.relaxation->to, 110.0) << "not the recoil";
  EXPECT_EQ(results.max_penetration, 0.0);
  // Held at a load, it creeps on before.
  held[3].extension = held[3].displacement = held[4].extension = held[4].displacement = 0.012;
  results = on_rollers(held, EndedBy::kBreak);
  EXPECT_EQ(results.break_extension, 0.012);
  EXPECT_NEAR(*results.energy_to_break, 0.5 + 0.002 * (100.0 + 110.0) / 2.0, 1e-12);
  for (const Phase phase : {Phase::kPreload, Phase::kMount, Phase::kBalance, Phase::kHold}) {
    std::vector<Sample> early = {reading(phase, 0.005, 0.0), reading(phase, 0.005, 50.0), reading(phase, 0.005, 60.0)};
    early[1].status = early[2].status = BenchStatus::kBroken;
    results = on_rollers(early, EndedBy::kBreak);
    if (phase == Phase::kPreload)
      EXPECT_EQ(results.break_extension, 0.005);
    else
      EXPECT_FALSE(results.break_extension) << "it was not pulled yet";
    EXPECT_EQ(results.true_peak_force, 50.0);
    EXPECT_FALSE(results.energy_to_break);
  }
}

TEST(Results, RelaxationIsThatOfTheLastHoldUnderALoad) {
  std::vector<Sample> samples;
  const auto add = [&](Phase phase, double displacement, double force) {
    samples.push_back(reading(phase, displacement, force));
  };
  add(Phase::kIdle, 0.0, 0.5);
  add(Phase::kHold, 0.0, 0.4);
  EXPECT_FALSE(on_rollers(samples, EndedBy::kProgram).relaxation) << "a shape that settles";
  add(Phase::kPull, 0.01, 100.0);
  add(Phase::kHold, 0.01, 90.0);
  add(Phase::kHold, 0.01, 80.0);
  add(Phase::kPull, 0.02, 200.0);
  EXPECT_NEAR(on_rollers(samples, EndedBy::kProgram).relaxation->lost(), 0.2, 1e-12);
  add(Phase::kHold, 0.02, 190.0);
  add(Phase::kHold, 0.02, 150.0);
  const Results results = on_rollers(samples, EndedBy::kProgram);
  EXPECT_EQ(results.relaxation->from, 200.0);
  EXPECT_EQ(results.relaxation->to, 150.0);
  EXPECT_NEAR(results.relaxation->lost(), 0.25, 1e-12);
}

/// The bends of a rod that has buckled store more than its compression does.
TEST(Results, TheLargestThrustIsThatOfARodThatIsStillStraight) {
  std::vector<Sample> samples;
  for (const double force : {5.0, -3.0, -8.0, -2.0}) {
    samples.push_back(reading(Phase::kReturn, 0.0, force));
    samples.back().stretching_energy = 1e-3;
    samples.back().end_to_end = 0.25 + 1e-3 * force;
  }
  samples[2].bending_energy = 2e-3;
  Results results = on_rollers(samples, EndedBy::kProgram);
  EXPECT_EQ(results.largest_thrust, 3.0);
  EXPECT_EQ(results.span_at_largest_thrust, samples[1].end_to_end);
  samples[2].bending_energy = 0.0;
  EXPECT_EQ(on_rollers(samples, EndedBy::kProgram).largest_thrust, 8.0);
}

/// Of one phase, in samples that follow each other: the program tells where one hold ends and the next begins.
TEST(Results, TwoStepsInARowAreTwo) {
  const std::vector<Sample> held = {reading(Phase::kPull, 0.0, 0.0),     reading(Phase::kPull, 0.01, 100.0),
                                    reading(Phase::kHold, 0.015, 150.0), reading(Phase::kHold, 0.02, 200.0),
                                    reading(Phase::kHold, 0.02, 180.0),  reading(Phase::kHold, 0.02, 170.0),
                                    reading(Phase::kHold, 0.02, 165.0)};
  const auto relaxed = [&](const std::vector<int>& steps) {
    return analyse(held, held, EndedBy::kProgram, false, 0.0, 0.0, steps).relaxation;
  };
  EXPECT_FALSE(relaxed({0, 0, 1, 1, 1, 1, 1})) << "a load was held";
  EXPECT_EQ(relaxed({0, 0, 1, 1, 2, 2, 2})->from, 200.0) << "and then the crosshead";
  EXPECT_EQ(relaxed({0, 0, 1, 1, 2, 2, 3})->from, 170.0);
  std::vector<Sample> cycled;
  for (const double s : {0.0, 0.01, 0.0, 0.01, 0.0, 0.02, 0.0}) cycled.push_back(reading(Phase::kCycle, s, s));
  EXPECT_EQ(analyse(cycled, cycled, EndedBy::kProgram, false, 0.0, 0.0, {-1, 0, 0, 0, 0, 1, 1}).cycles, 1u);
  EXPECT_EQ(analyse(cycled, cycled, EndedBy::kProgram, false).cycles, 3u);
}

TEST(Results, EnergyPartsAreThoseOfThePullAndWhatFollows) {
  std::vector<Sample> samples = Curve().samples();
  samples.front().phase = Phase::kHold;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double x = static_cast<double>(i);
    samples[i].grip_work = 5.0 + 1.1 * x;
    samples[i].stretching_energy = 0.3 * x;
    samples[i].contact_energy = 0.1 * x;
    samples[i].kinetic_energy = 0.05 * x;
    samples[i].dissipation = 0.5 * x;
    samples[i].plastic_loss = 0.1 * x;
    samples[i].friction_loss = 0.3 * x;
    samples[i].numerical_dissipation = 0.2 * x;
    samples[i].reweighting_loss = -0.05 * x;
  }
  const Results results = on_rollers(samples, EndedBy::kExtension);
  const double last = static_cast<double>(samples.size() - 1);
  ASSERT_TRUE(results.energy);
  EXPECT_NEAR(results.energy->work, 1.1 * last, 1e-9);
  EXPECT_NEAR(results.energy->stored, 0.4 * last, 1e-9);
  EXPECT_NEAR(results.energy->kinetic, 0.05 * last, 1e-9);
  EXPECT_NEAR(results.energy->friction, 0.3 * last, 1e-9);
  EXPECT_NEAR(results.energy->plastic, 0.1 * last, 1e-9);
  EXPECT_NEAR(results.energy->drag, 0.1 * last, 1e-9);
  EXPECT_NEAR(results.energy->numerical, 0.2 * last, 1e-9);
  EXPECT_NEAR(results.energy->reweighting, -0.05 * last, 1e-9);
  EXPECT_NEAR(results.energy->gap(), 0.0, 1e-9);
  EXPECT_NEAR(*results.energy_balance_error, 0.0, 1e-12);
  samples.back().dissipation -= 0.011 * last;
  EXPECT_NEAR(*on_rollers(samples, EndedBy::kExtension).energy_balance_error, 0.01, 1e-9);
}

/// A parted rod lets go of the grip: what it does to the grip then is no work of the test.
TEST(Results, EnergyPartsEndAtTheBreak) {
  std::vector<Sample> samples = Curve().samples();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    Sample& sample = samples[i];
    if (i == 0) sample.kinetic_energy = 0.5;  // at rest later on
    sample.grip_work = 0.5 * (i == 0 ? 0.0 : samples[i - 1].force_upper + sample.force_upper) *
                           (i == 0 ? 0.0 : sample.extension - samples[i - 1].extension) +
                       (i == 0 ? 0.0 : samples[i - 1].grip_work);
  }
  samples.back().status = BenchStatus::kBroken;
  Sample recoil = samples.back();
  recoil.time += 0.001;
  recoil.force_upper = -100.0;
  recoil.grip_work -= 1.64;
  recoil.kinetic_energy = 19.5;
  samples.push_back(recoil);
  const Results results = on_rollers(samples, EndedBy::kBreak);
  ASSERT_TRUE(results.energy && results.energy_to_break);
  EXPECT_NEAR(results.energy->work, *results.energy_to_break, 1e-6 * *results.energy_to_break);
  EXPECT_EQ(results.kinetic_energy, 0.0);  // not its change, which is negative
  EXPECT_EQ(results.energy->kinetic, -0.5);
}

TEST(Results, MomentBalanceIsThatOfThePull) {
  std::vector<Sample> samples = Curve().samples();
  Sample tie;
  tie.phase = Phase::kTie;
  tie.moment_imbalance = 1e3;
  samples.insert(samples.begin(), tie);
  Sample& worst = samples[samples.size() / 2];
  worst.moment_imbalance = 0.02;
  const Results results = on_rollers(samples, EndedBy::kExtension);
  EXPECT_NEAR(*results.moment_arm, 0.02 / worst.force_upper, 1e-12);
}

TEST(Results, ForcesAreThoseOfTheBalancedLoadAndTheTrueOnesAreLargerByTheBalanceOffset) {
  std::vector<Sample> samples = Curve().samples();
  for (Sample& sample : samples) {
    sample.balance_offset = 1.5;
    sample.load = sample.force_upper - 1.5;
  }
  const Results results = on_rollers(samples, EndedBy::kExtension);
  const double peak = samples.back().force_upper;
  EXPECT_EQ(results.balance_offset, 1.5);
  EXPECT_DOUBLE_EQ(*results.curve.peak_force, peak - 1.5);
  EXPECT_DOUBLE_EQ(*results.true_peak_force, peak);
  EXPECT_NEAR(*results.true_plateau_force, *results.curve.plateau_force + 1.5, 1e-12);
  EXPECT_NEAR(*results.true_breakaway_force, *results.curve.breakaway_force + 1.5, 1e-12);
}

TEST(Results, ReadingsOfTheCellAreNotThoseOfEveryTimeStep) {
  Curve curve;
  curve.step = 1e-4;
  const std::vector<Sample> samples = curve.samples();
  std::vector<Sample> readings;
  for (std::size_t i = 0; i < samples.size(); i += 11) readings.push_back(samples[i]);
  const Results results = analyse(samples, readings, EndedBy::kExtension, true);
  EXPECT_EQ(results.curve.peak_force, readings.back().load);
  EXPECT_LT(*results.curve.peak_force, samples.back().load);
  EXPECT_EQ(results.curve.plateau_force, on_rollers(readings, EndedBy::kExtension).curve.plateau_force);
  EXPECT_EQ(results.lock_extension, on_rollers(samples, EndedBy::kExtension).lock_extension);
}

/// The plateau, half of the way, grows by half of `rise`.
TEST(Analyse, OnlyALevelLoadIsAPlateau) {
  const auto read = [](double rise, double noise, double jerk, unsigned seed) {
    Curve curve;
    curve.rise = rise;
    curve.noise = noise;
    curve.jerk = jerk;
    curve.seed = seed;
    return on_rollers(curve.samples(), EndedBy::kExtension);
  };
  for (unsigned seed = 1; seed <= 20; ++seed) {
    for (const double rise : {0.0, 0.4, -0.4}) {  // by 20 % of its mean over the plateau
      for (const auto& [noise, jerk] : {std::pair{0.01, 0.0}, std::pair{0.06, 0.0}, std::pair{0.02, 0.3}}) {
        const Results level = read(rise, noise, jerk, seed);
        EXPECT_EQ(level.motion_pattern, MotionPattern::kSliding);
        EXPECT_EQ(level.curve.no_plateau, "") << "rise " << rise << ", noise " << noise << ", jerk " << jerk;
        EXPECT_NEAR(level.true_plateau_force.value_or(0.0), 6.6 * (1.0 + 0.05 * rise), 0.06 * 6.6);
        EXPECT_TRUE(level.curve.plateau_force_low && level.curve.plateau_force_sd && level.true_breakaway_force);
      }
    }
    // Threefold from begin to lock, and by half over the plateau.
    for (const double rise : {1.0, 0.833}) {
      for (const auto& [noise, jerk] : {std::pair{0.01, 0.0}, std::pair{0.03, 0.0}, std::pair{0.02, 0.2}}) {
        const Results grows = read(rise, noise, jerk, seed);
        EXPECT_EQ(grows.motion_pattern, MotionPattern::kSliding);
        EXPECT_THAT(grows.curve.no_plateau, testing::HasSubstr("the load is not level: "));
        EXPECT_FALSE(grows.true_plateau_force || grows.curve.plateau_force_sd || grows.curve.plateau_force_low ||
                     grows.curve.plateau_force_high || grows.curve.plateau_force_slope || grows.plateau_slope ||
                     grows.curve.breakaway_force || grows.true_breakaway_force || grows.curve.lock_extension_by_load);
        EXPECT_TRUE(grows.lock_extension && grows.curve.locked_stiffness) << "these the knots tell";
      }
    }
  }
}

}  // namespace
}  // namespace knot_utm
