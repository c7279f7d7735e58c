// How knots move while they are pulled, and the stiffness once they hold.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "analysis/made_up_curve.hpp"
#include "knot_utm/analysis/results.hpp"

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

}  // namespace
}  // namespace knot_utm
