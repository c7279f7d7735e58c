// How knots move while they are pulled, and the stiffness once they hold.

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "analysis/made_up_curve.hpp"
#include "knot_utm/analysis/plateau_watch.hpp"
#include "knot_utm/analysis/results.hpp"
#include "knot_utm/analysis/statistics.hpp"

namespace knot_utm {
namespace {

using made_up::Curve;
using made_up::on_rollers;

TEST(MotionPattern, SlidingThenStretching) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Curve curve;
    curve.seed = seed;
    curve.lock = 0.05 + 0.003 * seed;
    curve.breakaway = 0.2 * seed;
    for (const double step : {1.1e-3, 1e-4}) {
      curve.step = step;
      const Results results = on_rollers(curve.samples(), EndedBy::kExtension);
      EXPECT_EQ(results.motion_pattern, MotionPattern::kSliding);
      EXPECT_GT(results.motion_pattern_confidence, 0.85);
      ASSERT_TRUE(results.lock_extension);
      // de/ds passes -1 a little before the middle of the soft turn, and e lags the rate by half a step.
      EXPECT_NEAR(*results.lock_extension, curve.lock, 1.5e-3);
      ASSERT_TRUE(results.curve.lock_extension_by_load);
      EXPECT_NEAR(*results.curve.lock_extension_by_load, curve.lock, 1.5e-3);
      ASSERT_TRUE(results.true_plateau_force);
      EXPECT_NEAR(*results.true_plateau_force, curve.plateau, 0.03 * curve.plateau);
      EXPECT_LT(*results.curve.plateau_force_sd, 0.05 * curve.plateau);
      EXPECT_NEAR(*results.plateau_slope, -2.0, 0.02);
      ASSERT_TRUE(results.curve.locked_stiffness);
      EXPECT_NEAR(*results.curve.locked_stiffness, curve.stiffness, 0.01 * curve.stiffness);
      EXPECT_FALSE(results.untangled_at);
      EXPECT_EQ(results.knot_type, KnotType::kKept);
      EXPECT_NEAR(*results.force_balance_error, 1e-3, 1e-4);
    }
  }
}

TEST(MotionPattern, StretchingFromTheStart) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Curve curve;
    curve.seed = seed;
    curve.lock = 0.0;
    curve.stiffness = 20.0 * seed;
    curve.plateau = 0.01 * curve.stiffness;
    const Results results = on_rollers(curve.samples(), EndedBy::kExtension);
    EXPECT_EQ(results.motion_pattern, MotionPattern::kStretching);
    EXPECT_GT(results.motion_pattern_confidence, 0.95);
    EXPECT_FALSE(results.lock_extension);
    EXPECT_FALSE(results.true_plateau_force);
    EXPECT_NEAR(*results.curve.locked_stiffness, curve.stiffness, 0.01 * curve.stiffness);
  }
}

TEST(LockedStiffness, DoesNotSeeASlipInsideTheLock) {
  Curve curve;
  curve.step = 1e-4;
  std::vector<Sample> samples = curve.samples();
  double peak = 0.0;
  for (const Sample& sample : samples) peak = std::max(peak, sample.force_upper);
  const double whole = *on_rollers(samples, EndedBy::kExtension).curve.locked_stiffness;
  for (Sample& sample : samples) {
    if (sample.force_upper < 0.75 * peak) continue;
    sample.force_upper -= 0.03 * peak;
    sample.force_lower -= 0.03 * peak;
  }
  // One part in three holds the slip, and is left out.
  EXPECT_NEAR(*on_rollers(samples, EndedBy::kExtension).curve.locked_stiffness, whole, 2e-3 * whole);
}

/// A knot jumps open at s = 0.03 m, as is told live and in the end, and the loop slides and locks as a looser one. How
/// long it is pulled from there on changes nothing.
TEST(MotionPattern, UntanglingWhereAKnotJumpsOpenHoweverLongIsPulled) {
  const auto jumps = [](double force_left, double takes_in) {
    std::vector<Sample> samples = Curve().samples();
    for (Sample& sample : samples) {
      if (sample.extension < 0.03) continue;
      if (sample.extension < 0.08) sample.force_upper = sample.force_lower = force_left * sample.force_upper;
      sample.excess_length[1] += takes_in;
    }
    return samples;
  };
  for (const double end : {0.034, 0.05, 0.12}) {
    std::vector<Sample> samples = jumps(1e-3, 0.06);
    while (samples.back().extension > end) samples.pop_back();
    const Results results = on_rollers(samples, EndedBy::kExtension);
    EXPECT_EQ(results.motion_pattern, MotionPattern::kUntangling) << end;
    EXPECT_EQ(results.motion_pattern_confidence, 0.75) << end;
    EXPECT_TRUE(results.curve.jump_force) << end;
    EXPECT_FALSE(results.untangled_at) << "its topology is the same";
    EXPECT_FALSE(results.lock_extension || results.curve.plateau_force || results.curve.locked_stiffness) << end;
    EXPECT_EQ(results.failure_mode, "") << end;
    EXPECT_EQ(on_rollers(samples, EndedBy::kBreak).failure_mode, "untangling then fracture") << end;
  }
  MotionPatternTracker live(true);
  for (const Sample& sample : jumps(1e-3, 0.06)) {
    live.add(sample);
    if (sample.extension < 0.0299) {
      EXPECT_NE(live.pattern(), MotionPattern::kUntangling);
    } else if (sample.extension > 0.04) {
      EXPECT_EQ(live.pattern(), MotionPattern::kUntangling) << sample.extension;
    }
  }
  // A low load alone, in knots that did not open, is a slide after a high breakaway; one that rises is no jump.
  EXPECT_EQ(on_rollers(jumps(1e-3, 0.0), EndedBy::kExtension).motion_pattern, MotionPattern::kSliding);
  EXPECT_EQ(on_rollers(jumps(1.2, 0.06), EndedBy::kExtension).motion_pattern, MotionPattern::kSliding);
  std::vector<Sample> single = jumps(1e-3, 0.06);
  for (Sample& sample : single) sample.knot_distance = Sample::kNone;
  EXPECT_FALSE(on_rollers(single, EndedBy::kExtension).curve.jump_force);
}

TEST(MotionPattern, UntanglingWhenTheKnotTypeIsLostAndTheLoadIsGone) {
  std::vector<Sample> samples = Curve().samples();
  std::optional<double> lost_at;
  for (Sample& sample : samples) {
    if (sample.time < 12.5) continue;
    sample.knot_type = KnotType::kChanged;
    sample.force_upper = sample.force_lower = sample.load = 0.0;
    if (!lost_at) lost_at = sample.time;
  }
  const Results results = on_rollers(samples, EndedBy::kExtension);
  EXPECT_EQ(results.motion_pattern, MotionPattern::kUntangling);
  EXPECT_EQ(results.motion_pattern_confidence, 1.0);
  EXPECT_EQ(results.untangled_at, lost_at);
  EXPECT_EQ(results.knot_type, KnotType::kChanged);
  EXPECT_FALSE(results.curve.locked_stiffness);
}

/// The loop that is left may bear a load: its own weight, or a strand around a roller.
TEST(MotionPattern, UntanglingWhenTheKnotTypeIsLostAndTheRodHasRunOutOfAKnot) {
  std::vector<Sample> samples = Curve().samples();
  for (Sample& sample : samples) {
    sample.excess_length[0] = sample.excess_length[1] = 0.04;
    if (sample.time < 12.5) continue;
    sample.knot_type = KnotType::kChanged;
    sample.excess_length[0] = 1e-9;
  }
  const Results results = on_rollers(samples, EndedBy::kExtension);
  EXPECT_EQ(results.motion_pattern, MotionPattern::kUntangling);
  EXPECT_FALSE(results.true_plateau_force);
  EXPECT_FALSE(results.lock_extension);
  for (Sample& sample : samples) sample.knot_distance = Sample::kNone;
  EXPECT_FALSE(on_rollers(samples, EndedBy::kExtension).untangled_at) << "a single knot, which was tightened";
}

/// The ends of the rod are joined outside to tell the knot type, where a roller can be in the way.
TEST(MotionPattern, AKnotTypeThatChangesUnderLoadIsNoUntangling) {
  std::vector<Sample> samples = Curve().samples();
  for (Sample& sample : samples)
    if (sample.extension > 0.07) sample.knot_type = KnotType::kChanged;
  const Results results = on_rollers(samples, EndedBy::kExtension);
  EXPECT_EQ(results.motion_pattern, MotionPattern::kSliding);
  EXPECT_FALSE(results.untangled_at);
  EXPECT_TRUE(results.curve.plateau_force);
  // Where the rod ran through itself no load says that it did not.
  samples.back().knot_type = KnotType::kCrossed;
  EXPECT_EQ(on_rollers(samples, EndedBy::kExtension).motion_pattern, MotionPattern::kUntangling);
}

/// A loop that stretches loads its knots until they give way, at a force that stays, and lock.
TEST(MotionPattern, KnotsThatHeldFirstSlideWhereTheLoadThenStaysLevel) {
  std::vector<Sample> samples = Curve().samples();
  const auto with_load = [&](double grows) {
    for (Sample& sample : samples) {
      const double s = sample.extension, slid = std::clamp(s - 0.06, 0.0, 0.03);
      sample.knot_distance = 0.15 + 0.4 * std::min(s, 0.06) - 1.8 * slid;
      sample.force_upper = 500.0 * std::min(s, 0.06) * std::exp(grows * slid) + 500.0 * std::max(0.0, s - 0.09);
      sample.load = sample.force_lower = sample.force_upper;
    }
    return on_rollers(samples, EndedBy::kExtension);
  };
  const Results level = with_load(0.0);
  EXPECT_EQ(level.motion_pattern, MotionPattern::kSliding);
  ASSERT_TRUE(level.lock_extension);
  EXPECT_NEAR(*level.lock_extension, 0.09, 3e-3);
  EXPECT_FALSE(level.curve.lock_extension_by_load);
  EXPECT_EQ(with_load(150.0).motion_pattern, MotionPattern::kStretching) << "another strand bears the load";
}

/// The knots hold until s = 0.03 m, and then come nearer to each other at a rate, while the load grows with s.
std::vector<Sample> sliding_under_a_growing_load(double rate, double grows) {
  std::vector<Sample> samples = Curve().samples();
  for (Sample& sample : samples) {
    const double s = sample.extension, slid = std::max(0.0, s - 0.03);
    sample.knot_distance = 0.15 + rate * slid;
    sample.load = sample.force_upper = sample.force_lower = std::exp(std::min(s, 0.03) * 100.0) * (1.0 + grows * slid);
  }
  return samples;
}

/// No rod passes from side to side: knots that slide lengthen one side of the loop, and the other one is stretched.
TEST(MotionPattern, RigidSlidingBetweenHeldNodesIsHalfAsFastAsOnRollers) {
  const std::vector<Sample> slides = sliding_under_a_growing_load(-0.97, 1e4);
  const Results held = analyse(slides, slides, EndedBy::kExtension, false);
  EXPECT_EQ(held.motion_pattern, MotionPattern::kSliding);
  EXPECT_FALSE(held.lock_extension) << "they slide to the end";
  EXPECT_EQ(held.curve.no_plateau,
            "two nodes of the loop are held: the load is also that of the side without knots, which is stretched");
  EXPECT_EQ(on_rollers(slides, EndedBy::kExtension).motion_pattern, MotionPattern::kStretching);
  const std::vector<Sample> gives = sliding_under_a_growing_load(-0.4, 1e4);
  EXPECT_EQ(analyse(gives, gives, EndedBy::kExtension, false).motion_pattern, MotionPattern::kStretching);
}

TEST(MotionPattern, NoneWithoutAPullOrWithoutTwoKnots) {
  EXPECT_EQ(on_rollers({}, EndedBy::kOperator).motion_pattern, MotionPattern::kNone);
  std::vector<Sample> samples = Curve().samples();
  for (Sample& sample : samples) sample.phase = Phase::kHold;
  EXPECT_EQ(on_rollers(samples, EndedBy::kOperator).motion_pattern, MotionPattern::kNone);
  samples = Curve().samples();
  for (Sample& sample : samples) sample.knot_distance = Sample::kNone;
  const Results results = on_rollers(samples, EndedBy::kExtension);
  EXPECT_EQ(results.motion_pattern, MotionPattern::kNone);
  EXPECT_EQ(results.motion_pattern_confidence, 0.0);
  EXPECT_TRUE(results.curve.locked_stiffness);
}

using made_up::Curve;

constexpr double kRadius = 0.003;  // [m]

/// Knots 0.15 m apart that slide as far as s = `end`, whose load at s is `load`.
template <class Load>
Pull slid(double end, int points, Load load) {
  Pull pull;
  for (int i = 0; i <= points; ++i) {
    const double s = end * i / points;
    pull.push_back({s, s, 0.15 - 2.0 * s, load(s)});
  }
  return pull;
}

/// What is left of the samples when the watch has ended the test; empty: it never did.
std::optional<std::vector<Sample>> ended_early(const std::vector<Sample>& samples, std::optional<double> error = {}) {
  PlateauWatch watch(kRadius, error);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    watch.add(samples[i]);
    if (watch.settled_by(samples[i])) return std::vector<Sample>(samples.begin(), samples.begin() + i + 1);
  }
  return std::nullopt;
}

/// The means of five parts of a line differ by the growth over a part each; the plateau lies from 0.0225 to 0.06 m.
TEST(DoubtAboutAPlateau, OfALoadThatGrowsIsThatOfItsTrendAndOfWhatIsLeft) {
  const double slope = 10.0, end = 0.05, width = end - 0.0225;
  const Pull pull = slid(end, 200, [&](double s) { return 3.0 + slope * s; });
  const double sd = slope * width / 5.0 * std::sqrt(2.5), left = 0.06 - end;
  EXPECT_NEAR(doubt_about_plateau(pull),
              student_95(4) * sd / std::sqrt(5.0) * std::sqrt(left / 0.0375) + slope * left / 2.0, 1e-9);
}

TEST(DoubtAboutAPlateau, IsGoneOnceAllOfItHasBeenRead) {
  const auto waves = [](double s) { return 3.0 + std::sin(200.0 * s); };
  EXPECT_GT(doubt_about_plateau(slid(0.055, 200, waves)), 0.01);
  EXPECT_EQ(doubt_about_plateau(slid(0.0601, 200, waves)), 0.0);
}

TEST(DoubtAboutAPlateau, IsInfiniteWhereTooLittleWasRead) {
  const auto level = [](double) { return 3.0; };
  EXPECT_TRUE(std::isinf(doubt_about_plateau({})));
  EXPECT_TRUE(std::isinf(doubt_about_plateau(slid(0.02, 200, level)))) << "the plateau has not begun";
  EXPECT_TRUE(std::isinf(doubt_about_plateau(slid(0.06, 10, level)))) << "fewer than two readings a part";
  EXPECT_NEAR(doubt_about_plateau(slid(0.05, 200, level)), 0.0, 1e-9);
}

TEST(PlateauWatch, EndsALevelPlateauAfterEightRadiiOfIt) {
  const auto left = ended_early(Curve().samples());
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->back().extension, 0.0225 + 8.0 * kRadius, 2.0 * Curve().step);
}

TEST(PlateauWatch, LooksLongerAtAPlateauThatRisesAndAtOneThatIsToBeKnownBetter) {
  std::vector<Sample> rises = Curve().samples();
  for (Sample& sample : rises)
    for (double* load : {&sample.load, &sample.force_upper, &sample.force_lower}) *load *= 1.0 + 5.0 * sample.extension;
  const auto level = ended_early(Curve().samples()), rising = ended_early(rises),
             precise = ended_early(Curve().samples(), 1e-4);
  ASSERT_TRUE(level && rising && precise);
  EXPECT_GT(rising->back().extension, level->back().extension);
  EXPECT_GT(precise->back().extension, level->back().extension);
  EXPECT_LE(precise->back().extension, 0.06 + Curve().step) << "the whole plateau";
}

TEST(PlateauWatch, LeavesThePlateauOfTheWholeTestWithinItsDoubt) {
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
    Curve curve;
    curve.noise = 0.05;
    curve.seed = seed;
    const auto left = ended_early(curve.samples());
    ASSERT_TRUE(left);
    const Results early = made_up::on_rollers(*left, EndedBy::kPlateau),
                  whole = made_up::on_rollers(curve.samples(), EndedBy::kExtension);
    EXPECT_NEAR(*early.curve.plateau_force, *whole.curve.plateau_force, 0.03 * curve.plateau);
  }
}

TEST(PlateauWatch, EndsNoTestWithoutAPlateau) {
  Curve stretches;
  stretches.lock = 0.0;
  EXPECT_FALSE(ended_early(stretches.samples()));
  Curve locks;
  locks.lock = 0.03;
  EXPECT_FALSE(ended_early(locks.samples())) << "it locks within the plateau";
  std::vector<Sample> touches = Curve().samples();
  for (Sample& sample : touches) sample.knots_force = sample.extension > 0.04 ? 1.0 : 0.0;
  EXPECT_FALSE(ended_early(touches));
  Curve coarse;
  coarse.step = 0.006;
  EXPECT_FALSE(ended_early(coarse.samples())) << "too few readings";
}

}  // namespace
}  // namespace knot_utm
