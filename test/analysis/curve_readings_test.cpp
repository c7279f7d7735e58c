#include "knot_utm/analysis/curve_readings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>

#include "knot_utm/analysis/pull_readings.hpp"
#include "knot_utm/analysis/results.hpp"
#include "knot_utm/analysis/sample_readings.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {
namespace {

/// Of a loop on rollers.
CurveReadings curve_readings(const Pull& pull, const HiddenRod& hidden = {}) {
  return curve_readings(pull, true, hidden);
}

Pull pull(const std::function<double(double)>& force, double end = 0.12, int points = 1200) {
  Pull out;
  for (int i = 0; i <= points; ++i) {
    const double s = end * i / points;
    out.push_back({s / 3.3e-3, s, Sample::kNone, force(s)});
  }
  return out;
}

/// 6 N that slide, and 2e5 N/m behind s = 0.08 m.
double sliding(double s) { return 6.0 * std::min(1.0, s / 1e-3) + 2e5 * std::max(0.0, s - 0.08); }

TEST(CurveReadings, ASlidingKnotHasAPlateauALockAndAStiffness) {
  const CurveReadings readings = curve_readings(pull(sliding));
  EXPECT_NEAR(*readings.plateau_force, 6.0, 1e-12);
  EXPECT_NEAR(*readings.plateau_force_sd, 0.0, 1e-6);  // the root of a rounding of 36 N^2
  // Twice the plateau is reached 6 N / (2e5 N/m) behind the corner.
  EXPECT_NEAR(*readings.lock_extension_by_load, 0.08 + 6.0 / 2e5, 1e-9);
  EXPECT_NEAR(*readings.locked_stiffness, 2e5, 1e-4);
  EXPECT_DOUBLE_EQ(*readings.peak_force, 6.0 + 2e5 * 0.04);
  EXPECT_DOUBLE_EQ(*readings.breakaway_force, 6.0);
}

/// F = k s^2/2: the slope is k s.
TEST(CurveReadings, TellsHowTheStiffnessChangesOverThePartThatItIsReadFrom) {
  const CurveReadings readings = curve_readings(pull([](double s) { return 0.5 * 1e4 * s * s; }, 0.1, 20000));
  ASSERT_TRUE(readings.locked);
  const double from = 0.1 / std::sqrt(2.0), width = 0.1 - from;
  EXPECT_NEAR(readings.locked->width, width, 1e-5);
  EXPECT_NEAR(readings.locked->stiffness, 1e4 * (from + 0.5 * width), 0.1);
  EXPECT_NEAR(readings.locked->change, 1e4 * width, 0.1);
  EXPECT_DOUBLE_EQ(*readings.locked_stiffness, readings.locked->stiffness);
}

TEST(CurveReadings, BesideTheMeanStandWhatItIsTheMeanOf) {
  const CurveReadings readings = curve_readings(pull([](double s) { return sliding(s) + 50.0 * s; }));
  const double lock = *readings.lock_extension_by_load;
  EXPECT_NEAR(*readings.plateau_force_low, 6.0 + 50.0 * 0.3 * lock, 1e-9);
  EXPECT_NEAR(*readings.plateau_force_high, 6.0 + 50.0 * 0.8 * lock, 1e-9);
  EXPECT_NEAR(*readings.plateau_force_slope, 50.0, 1e-6);
  EXPECT_EQ(readings.no_plateau, "");
  EXPECT_EQ(*readings.largest_drop, 0.0);
  EXPECT_FALSE(readings.largest_drop_at || readings.jump_force);
}

TEST(CurveReadings, AForceThatFallsAllTheWayHasNoPlateau) {
  const CurveReadings readings = curve_readings(pull([](double s) { return sliding(s) - 70.0 * std::min(s, 0.08); }));
  EXPECT_FALSE(readings.lock_extension_by_load) << "a lock is where F doubles, and there is nothing to be doubled";
  EXPECT_EQ(readings.no_lock_by_load, "there is no plateau");
  EXPECT_FALSE(readings.plateau_force || readings.plateau_force_low || readings.breakaway_force);
  EXPECT_NE(readings.no_plateau.find("not level"), std::string::npos) << readings.no_plateau;
}

/// e of knots that slide up to s = 0.08 m, less what a knot lets out at s = 0.03 m.
Pull with_knots(Pull pull, double let_out, double rate = -2.0) {
  for (PullPoint& point : pull) {
    point.knot_distance = 0.2 + rate * std::min(point.extension, 0.08);
    if (point.extension > 0.03) {
      point.knot_distance -= let_out;
      if (let_out > 0.0) point.force *= 0.1;
    }
  }
  return pull;
}

TEST(CurveReadings, AKnotThatJumpsOpenHasTheForceAtWhichItDidAndNoPlateau) {
  const CurveReadings kept = curve_readings(with_knots(pull(sliding), 0.0));
  EXPECT_TRUE(kept.plateau_force);
  EXPECT_FALSE(kept.jump_force);
  const CurveReadings jumped = curve_readings(with_knots(pull(sliding), 0.02));
  ASSERT_TRUE(jumped.jump_force);
  EXPECT_NEAR(*jumped.jump_force, 6.0, 1e-9);
  EXPECT_NEAR(*jumped.force_after_jump, 0.6, 1e-9);
  EXPECT_NEAR(*jumped.jump_extension, 0.03, 5e-3);
  EXPECT_NEAR(*jumped.largest_drop, 5.4, 1e-9);
  EXPECT_FALSE(jumped.plateau_force || jumped.lock_extension_by_load || jumped.locked_stiffness);
  EXPECT_NE(jumped.no_plateau.find("jumped open"), std::string::npos);
  // Ten times the size, a thousand times the force.
  Pull large = with_knots(pull(sliding), 0.02);
  for (PullPoint& point : large) {
    point.extension *= 10.0;
    point.knot_distance *= 10.0;
    point.force *= 1e3;
  }
  EXPECT_NEAR(*curve_readings(large).jump_force, 1e3 * *jumped.jump_force, 1e-6);
}

/// What the coils take in tells a jump from knots that slip as strands shorten: as much, or a third of it.
TEST(CurveReadings, NothingJumpsWhereNothingIsPulled) {
  EXPECT_FALSE(jump({}, true, {}));
  EXPECT_FALSE(jump({}, true, {{0.08, 0.08}, {0.08, 0.2}}));
}

TEST(CurveReadings, AKnotThatTakesInRodAtOnceJumpedOpen) {
  const auto slips = [](double takes_in, double force_left) {
    Pull out = with_knots(pull(sliding), 0.0);
    HiddenRod hidden;
    for (PullPoint& point : out) {
      const bool behind = point.extension > 0.03;
      if (behind) point.knot_distance -= 0.02;
      if (behind) point.force *= force_left;
      if (std::isfinite(takes_in)) hidden.push_back({0.08, 0.08 + (behind ? takes_in : 0.0)});
    }
    return curve_readings(out, hidden);
  };
  EXPECT_TRUE(slips(0.0225, 0.88).jump_force) << "28 % of what it held";
  EXPECT_FALSE(slips(0.0225, 0.95).jump_force) << "the load hardly falls";
  EXPECT_FALSE(slips(0.0225, 1.1).jump_force) << "the load rises";
  EXPECT_FALSE(slips(0.0225, 2.0).jump_force) << "it locks";
  EXPECT_FALSE(slips(0.0048, 0.5).jump_force) << "6 %";
  EXPECT_FALSE(slips(0.0, 0.1).jump_force);
  EXPECT_TRUE(slips(Sample::kNone, 0.4).jump_force);
  EXPECT_FALSE(slips(Sample::kNone, 0.95).jump_force)
      << "green VPS that slips as it is stretched to 1.25 of its length";
}

TEST(CurveReadings, AreJudgedByTheForceThatTheRodBears) {
  const Pull borne = with_knots(pull(sliding), 0.0);
  const CurveReadings a = curve_readings(borne);
  Pull balanced = borne;
  for (PullPoint& point : balanced) {
    point.borne = point.force;
    point.force -= 3.6;
  }
  const CurveReadings b = curve_readings(balanced);
  ASSERT_TRUE(a.plateau_force && b.plateau_force);
  EXPECT_NEAR(*b.plateau_force, *a.plateau_force - 3.6, 1e-9);
  EXPECT_NEAR(*b.lock_extension_by_load, *a.lock_extension_by_load, 1e-9);
  EXPECT_NEAR(*b.locked_stiffness, *a.locked_stiffness, 1e-6 * *a.locked_stiffness);
}

/// Noise of a cell of 50 kN: a third of the load.
TEST(CurveReadings, ACellsNoiseIsNothingThatTheKnotsDid) {
  Pull noisy = with_knots(pull(sliding), 0.0);
  for (std::size_t i = 0; i < noisy.size(); ++i) {
    noisy[i].borne = noisy[i].force;
    noisy[i].force += i % 2 == 0 ? 2.0 : -2.0;
  }
  const CurveReadings readings = curve_readings(noisy);
  EXPECT_NEAR(*readings.plateau_force, 6.0, 1e-3);
  EXPECT_NEAR(*readings.plateau_force_high, 8.0, 1e-9);
  EXPECT_EQ(*readings.largest_drop, 0.0);
  EXPECT_NEAR(*readings.lock_extension_by_load, 0.08 + 6.0 / 2e5, 1e-9);
}

TEST(CurveReadings, ALoopBetweenHeldNodesHasNoPlateauHoweverItsKnotsMove) {
  for (const double rate : {-0.97, 0.04, -2.0})
    EXPECT_EQ(curve_readings(with_knots(pull(sliding), 0.0, rate), false).no_plateau,
              "two nodes of the loop are held: the load is also that of the side without knots, which is stretched");
  EXPECT_EQ(curve_readings(pull(sliding), false).no_plateau, "") << "a strand without two knots has no such side";
}

TEST(CurveReadings, TheSameLinesByMorePointsAreTheSame) {
  const auto bent = [](double s) { return sliding(s) + 50.0 * std::max(0.0, s - 0.04); };
  Pull few;
  for (const double s : {0.0, 1e-3, 0.03, 0.04, 0.05, 0.08, 0.081, 0.12}) few.push_back({s, s, Sample::kNone, bent(s)});
  const CurveReadings a = curve_readings(few), b = curve_readings(pull(bent));
  EXPECT_NEAR(*a.lock_extension_by_load, *b.lock_extension_by_load, 1e-9);
  EXPECT_NEAR(*a.plateau_force, *b.plateau_force, 1e-9);
  EXPECT_NEAR(*a.plateau_force_sd, *b.plateau_force_sd, 1e-6);
  const CurveReadings line = curve_readings({{0.0, 0.0, Sample::kNone, 0.0}, {1.0, 0.1, Sample::kNone, 10.0}});
  EXPECT_FALSE(line.plateau_force || line.lock_extension_by_load);
}

/// Also where falls are equal, and where points are further apart than a fall may be.
TEST(CurveReadings, TheLargestDropIsThatOfAllPairs) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    Pull pull;
    double s = 0.0;
    for (int i = 0; i < 60; ++i) {
      PullPoint point;
      point.extension = s += 1e-4 * static_cast<double>(1 + random() % 40 * (random() % 4 == 0 ? 5 : 1));
      point.force = static_cast<double>(random() % 6);
      pull.push_back(point);
    }
    const double end = pull[55].extension, way = 0.05 * (end - pull.front().extension);
    std::optional<Drop> expected;
    for (std::size_t i = 0; i <= 55; ++i)
      for (std::size_t j = i + 1; j <= 55 && (j == i + 1 || pull[j].extension - pull[i].extension <= way); ++j) {
        const double fall = pull[i].force - pull[j].force, largest = expected ? expected->force(pull) : 0.0;
        if (fall > largest || (fall == largest && expected && i > expected->from)) expected = Drop{i, j};
      }
    const std::optional<Drop> found = largest_drop(pull, end);
    ASSERT_EQ(found.has_value(), expected.has_value()) << trial;
    if (!found) continue;
    EXPECT_EQ(found->from, expected->from) << trial;
    EXPECT_EQ(found->to, expected->to) << trial;
  }
}

Pull to_a_tenth(const std::function<double(double)>& force) { return pull(force, 0.1, 1000); }

/// The pull goes to s = 0.1. A force that rises by a from its middle on to its end differs by a/2 from quarter to
/// quarter.
TEST(PullReadings, SteadyForceIsTheMeanOfASecondHalfThatIsLevel) {
  const auto rising = [](double rise) {
    return to_a_tenth([rise](double s) { return s < 0.05 ? 200.0 * s : 10.0 + rise * (s - 0.05) / 0.05; });
  };
  EXPECT_NEAR(*steady_force(rising(0.0)), 10.0, 1e-9);
  EXPECT_NEAR(*steady_force(rising(0.3)), 10.15, 1e-9);
  EXPECT_FALSE(steady_force(rising(0.6)));
  EXPECT_FALSE(steady_force(to_a_tenth([](double s) { return 160.0 * s; })));
  EXPECT_FALSE(steady_force({}));
  EXPECT_FALSE(steady_force({{0.0, 0.1}}));
}

/// F = a s^2: s at a share of the peak is the root of it, and a tenth's least-squares slope is that in its middle.
TEST(PullReadings, OfAParabolaTheyAreItsClosedForms) {
  constexpr double kFactor = 3e4, kEnd = 0.1, kPeak = kFactor * kEnd * kEnd;
  const Pull parabola = to_a_tenth([](double s) { return kFactor * s * s; });
  const double step = kEnd / 1000.0;
  // A curve drawn straight from point to point is too high by no more than F'' step^2/8.
  const double drawn = 2.0 * kFactor * step * step / 8.0;
  EXPECT_NEAR(energy_to_peak(parabola), kFactor * std::pow(kEnd, 3) / 3.0, drawn * kEnd);
  const double chord = 0.4 * kPeak / (kEnd * (std::sqrt(0.5) - std::sqrt(0.1)));
  EXPECT_NEAR(*chord_stiffness(parabola), chord, chord * 10.0 * drawn / kPeak);
  EXPECT_NEAR(*secant_stiffness(parabola), kFactor * kEnd, 1e-9);
  EXPECT_NEAR(*tangent_stiffness(parabola), 2.0 * kFactor * 0.95 * kEnd, 3.0 * drawn / (0.1 * kEnd));
}

/// 6 N that slide, 2e5 N/m behind s = 0.08 m, and a breakaway above a tenth of the peak.
TEST(PullReadings, OfAKnotThatLocksTheChordIsThatOfTheLock) {
  const auto force = [](double s) {
    return 6.0 * std::min(1.0, s / 1e-3) + 1000.0 * std::exp(-std::pow((s - 0.01) / 1e-3, 2)) +
           2e5 * std::max(0.0, s - 0.08);
  };
  const Pull knot = to_a_tenth(force);
  EXPECT_NEAR(*chord_stiffness(knot), 2e5, 1e-6);
  EXPECT_NEAR(*secant_stiffness(knot), force(0.1) / 0.1, 1e-6);
  EXPECT_NEAR(*tangent_stiffness(knot), 2e5, 1e-4);
}

TEST(PullReadings, TheEnergyGoesOnBehindThePeakTheStiffnessesDoNot) {
  const Pull tent = pull([](double s) { return s < 0.06 ? 100.0 * s : 6.0 - 1e3 * (s - 0.06); }, 0.062, 620);
  EXPECT_NEAR(energy_to_peak(tent), 0.5 * 0.06 * 6.0, 1e-12);
  EXPECT_NEAR(energy(tent), 0.5 * 0.06 * 6.0 + 0.002 * (6.0 + 4.0) / 2.0, 1e-12);
  EXPECT_NEAR(*secant_stiffness(tent), 100.0, 1e-9);
  EXPECT_NEAR(*tangent_stiffness(tent), 100.0, 1e-9);
}

/// The same as that of each part by itself, whose sums begin with it.
TEST(PullReadings, TheSteepestTenthIsThatOfAllParts) {
  const Pull wild =
      to_a_tenth([](double s) { return 1e3 * s + 20.0 * std::sin(300.0 * s) + 2e5 * std::max(0.0, s - 0.07); });
  double steepest = 0.0;
  for (std::size_t i = 0; i + 100 < wild.size(); ++i) {  // least squares of straight pieces, s from the part's middle
    double moment = 0.0, middle = wild[i].extension + 0.005;
    for (std::size_t k = i; k < i + 100; ++k) {
      const double a = wild[k].extension - middle, b = wild[k + 1].extension - middle;
      const double fa = wild[k].force, fb = wild[k + 1].force;
      moment += (b - a) * (2.0 * a * fa + a * fb + b * fa + 2.0 * b * fb) / 6.0;
    }
    steepest = std::max(steepest, 12.0 * moment / std::pow(0.01, 3));
  }
  EXPECT_NEAR(*tangent_stiffness(wild), steepest, 1e-9 * steepest);  // sums of a thousand points, 1e3 times the part's
}

/// Straight from each place to the next, in 200 steps; F by s and which way it goes.
Path path(const std::vector<double>& places, const std::function<double(double s, bool out)>& force) {
  constexpr int kSteps = 200;
  Path out;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double from = places[i - 1], to = places[i];
    for (int k = i == 1 ? 0 : 1; k <= kSteps; ++k) {
      const double s = from + (to - from) * k / kSteps;
      out.push_back({s, force(s, to > from), s});
    }
  }
  return out;
}

/// A spring with dry friction beside it: 2 N more on the way out, 2 N less on the way back.
double rubbing_spring(double s, bool out) { return 200.0 * s + (out ? 2.0 : -2.0); }

TEST(ClosedCycles, OfDryFrictionTheAreaIsTwiceItsForceTimesTheWay) {
  const Path to_and_fro = path({0.0, 0.1, 0.0, 0.1, 0.0}, rubbing_spring);
  const std::vector<Cycle> cycles = closed_cycles(to_and_fro);
  ASSERT_EQ(cycles.size(), 2u);
  // Where it turns F falls within one step, along which the curve is straight.
  const double corner = 2.0 * 2.0 * 0.1 / 200.0;
  for (const Cycle& cycle : cycles) EXPECT_NEAR(cycle.hysteresis, 2.0 * 2.0 * 0.1, 1.01 * corner);
  EXPECT_EQ(cycles[0].end, cycles[1].begin);
}

TEST(ClosedCycles, TheWayToWhereTheyBeginAndWhatWasCutOffAreNone) {
  const std::vector<Cycle> cycles = closed_cycles(path({0.0, 0.1, 0.05, 0.1, 0.05, 0.1, 0.07}, rubbing_spring));
  ASSERT_EQ(cycles.size(), 1u);
  EXPECT_NEAR(cycles[0].hysteresis, 2.0 * 2.0 * 0.05, 1.01 * 2.0 * 2.0 * 0.05 / 200.0);
  EXPECT_EQ(cycles[0].begin, 400u);
  EXPECT_EQ(cycles[0].end, 800u);
  EXPECT_TRUE(closed_cycles(path({0.0, 0.1, 0.05}, rubbing_spring)).empty());
  EXPECT_TRUE(closed_cycles(path({0.1, 0.0, 0.1}, rubbing_spring)).empty()) << "back and out";
}

/// Between two loads: F comes back where s does not. The end is joined to the beginning at that load.
TEST(ClosedCycles, BetweenLoadsTheyCreepAndAreClosedAllTheSame) {
  Path creeping = {{0.0, 0.0}, {0.1, 10.0}, {0.05, 0.0}, {0.12, 10.0}, {0.08, 0.0}, {0.14, 10.0}, {0.11, 0.0}};
  for (PathPoint& point : creeping) point.crosshead = point.extension;
  const std::vector<Cycle> cycles = closed_cycles(creeping);
  ASSERT_EQ(cycles.size(), 3u);
  EXPECT_NEAR(cycles[0].hysteresis, 5.0 * (0.1 - 0.05), 1e-12);
  EXPECT_NEAR(cycles[1].hysteresis, 5.0 * (0.07 - 0.04), 1e-12);
  EXPECT_NEAR(cycles[2].hysteresis, 5.0 * (0.06 - 0.03), 1e-12);
}

/// The slack of a knot is taken up in the step that cycles: its cycles are a hundredth of that way.
TEST(ClosedCycles, SlackThatTheFirstOfThemTakesUpHidesNone) {
  const std::vector<double> places = {0.0, 0.1, 0.099, 0.1, 0.099, 0.1, 0.099};
  const auto knot = [](double s, bool out) { return std::max(0.0, 1e4 * (s - 0.0985)) + (out ? 2.0 : 0.0); };
  const std::vector<Cycle> cycles = closed_cycles(path(places, knot));
  ASSERT_EQ(cycles.size(), 2u) << "but not the way to where they begin";
  for (const Cycle& cycle : cycles) EXPECT_NEAR(cycle.hysteresis, 2.0 * 1e-3, 1.01 * 2.0 * 1e-3 / 200.0);
}

constexpr double kGauge = 0.5;     // [m]
constexpr double kReach = 0.01;    // [m]
constexpr double kSpring = 200.0;  // [N/m]

/// A specimen that is cycled between loads, and how much of its extension stays behind.
class Cycled {
 public:
  Cycled() { add(Phase::kBalance, 0.0); }

  void add(Phase phase, double extension) {
    Sample sample;
    sample.time = static_cast<double>(samples.size());
    sample.phase = phase;
    sample.extension = sample.displacement = extension;
    sample.end_to_end = kGauge + extension;
    sample.force_upper = sample.force_lower = sample.load = kSpring * (extension - left);
    samples.push_back(sample);
  }
  void move(Phase phase, double from, double to) {
    constexpr int kSteps = 50;
    for (int i = 1; i <= kSteps; ++i) add(phase, from + (to - from) * i / kSteps);
  }
  Results results() const { return analyse(samples, samples, EndedBy::kProgram, false); }

  double left = 0.0;  ///< [m]
  std::vector<Sample> samples;
};

/// What yields keeps a part of its extension, and is stretched the less by the same load afterwards.
TEST(Elongations, OfASpecimenThatBedsInAPartStaysAndIsNotElastic) {
  constexpr double kLeft = 0.004;
  Cycled rope;
  for (int i = 0; i < 3; ++i) {
    rope.move(Phase::kCycle, rope.left, kReach + kLeft * (i == 2));
    rope.left = kLeft * (i == 2);
    rope.move(Phase::kCycle, kReach + rope.left, rope.left);
  }
  const Results results = rope.results();
  ASSERT_TRUE(results.elongations);
  EXPECT_NEAR(results.elongations->total, (kReach + kLeft) / kGauge, 1e-15);
  EXPECT_NEAR(results.elongations->residual, kLeft / kGauge, 1e-15);
  EXPECT_NEAR(results.elongations->elastic, kReach / kGauge, 1e-15);
  EXPECT_NEAR(results.elongations->working, kReach / (kGauge + kLeft), 1e-15);
  EXPECT_NEAR(results.elongations->elastic + results.elongations->residual, results.elongations->total, 1e-15);
}

/// A reference tension stretches a specimen before anything is measured, and is not balanced.
TEST(Elongations, AreOverTheLengthThatIsFirstPulled) {
  constexpr double kBefore = 0.002;
  Cycled spring;
  spring.move(Phase::kPreload, 0.0, kBefore);
  spring.move(Phase::kCycle, kBefore, kReach);
  spring.move(Phase::kCycle, kReach, kBefore);
  spring.move(Phase::kPull, kBefore, 2.0 * kReach);
  spring.samples.back().status = BenchStatus::kBroken;
  const Results results = spring.results();
  ASSERT_TRUE(results.elongations && results.gauge_length && results.elongation_at_break);
  const double gauge = kGauge + kBefore;
  EXPECT_NEAR(*results.gauge_length, gauge, 1e-15);
  EXPECT_NEAR(results.elongations->total, (kReach - kBefore) / gauge, 1e-15);
  EXPECT_NEAR(results.elongations->residual, 0.0, 1e-15);
  EXPECT_NEAR(*results.elongation_at_break, (2.0 * kReach - kBefore) / gauge, 1e-15);
}

constexpr double kForce = 5.0, kDrag = 0.1, kHolder = 0.01, kNumerical = 0.2, kSpeed = 2e-3;  // [N], [m/s]

/// A steady pull for ten seconds, after a mount that drags more. What moves gains and loses an energy by turns.
std::vector<Sample> pulled(double gained) {
  std::vector<Sample> out;
  for (int k = 0; k <= 120; ++k) {
    Sample sample;
    sample.time = 0.1 * k;
    const double since = sample.time - 2.0;
    sample.phase = since > 1e-9 ? Phase::kPull : Phase::kMount;
    sample.extension = kSpeed * since;
    sample.force_upper = kForce;
    sample.force_lower = kForce - kDrag - kHolder * k;
    sample.kinetic_energy = k % 2 == 0 ? 0.0 : gained;
    sample.numerical_dissipation = -kNumerical * kSpeed * sample.time;
    sample.grip_work = kForce * kSpeed * sample.time;
    const double drag = since > 0.0 ? kDrag : 40.0 * kDrag;
    sample.friction_loss = 3.0 * sample.time;
    sample.plastic_loss = 2.0 * sample.time;  // is no drag
    sample.dissipation = sample.friction_loss + sample.plastic_loss + drag * kSpeed * since;
    out.push_back(sample);
  }
  return out;
}

TEST(RateShares, ADragThatIsSteadyIsItsShareOfTheForce) {
  const RateShares shares = rate_shares(pulled(0.0), {}, {});
  EXPECT_NEAR(*shares.drag, kDrag / kForce, 1e-9);
  EXPECT_NEAR(*shares.inertia, 0.0, 1e-9);  // what holds the loop elsewhere is none
  EXPECT_NEAR(*shares.numerical, kNumerical / kForce, 1e-9);
}

TEST(RateShares, MassThatGainsAndLosesSpeedIsInertia) {
  constexpr double kWay = 0.1 * kSpeed;
  EXPECT_NEAR(*rate_shares(pulled(1e-4), {}, {}).inertia, 1e-4 / kWay / kForce, 1e-9);
}

TEST(RateShares, EndWhereTheKnotsLockAndWhereTheyComeUndoneOrTheRodParts) {
  std::vector<Sample> samples = pulled(0.0);
  for (std::size_t k = 40; k < samples.size(); ++k) {
    samples[k].kinetic_energy = 1e3 * static_cast<double>(k);
    samples[k].dissipation += 1e3 * static_cast<double>(k);
  }
  EXPECT_GT(*rate_shares(samples, {}, {}).drag, 1.0);
  const double lock = 0.5 * (samples[38].extension + samples[39].extension);
  EXPECT_NEAR(*rate_shares(samples, lock, {}).drag, kDrag / kForce, 1e-9);
  EXPECT_NEAR(*rate_shares(samples, {}, samples[40].time).drag, kDrag / kForce, 1e-9);
  EXPECT_NEAR(*rate_shares(samples, {}, samples[40].time).inertia, 0.0, 1e-9);
  samples[40].status = BenchStatus::kBroken;
  EXPECT_NEAR(*rate_shares(samples, {}, {}).drag, kDrag / kForce, 1e-9);
}

}  // namespace
}  // namespace knot_utm
