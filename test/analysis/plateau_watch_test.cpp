#include "knot_utm/analysis/plateau_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "analysis/made_up_curve.hpp"
#include "knot_utm/analysis/statistics.hpp"

namespace knot_utm {
namespace {

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

/// What only the rest of the pull would tell is left out, and what made the knots slide is not.
TEST(PlateauWatch, LeavesReadingsOfTheRestOfThePullEmpty) {
  const Results early = made_up::on_rollers(*ended_early(Curve().samples()), EndedBy::kPlateau);
  EXPECT_EQ(early.motion_pattern, MotionPattern::kSliding);
  EXPECT_TRUE(early.curve.no_plateau.empty());
  EXPECT_TRUE(early.curve.breakaway_force && early.true_plateau_force && early.plateau_slope);
  EXPECT_EQ(early.curve.no_lock_by_load, kEndedInPlateau);
  EXPECT_FALSE(early.lock_extension || early.curve.locked_stiffness || early.curve.peak_force);
  EXPECT_FALSE(early.curve.largest_drop || early.chord_stiffness || early.energy_to_peak);
}

}  // namespace
}  // namespace knot_utm
