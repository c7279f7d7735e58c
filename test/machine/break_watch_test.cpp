// Which time steps of a rod that can part are believed.
#include "knot_utm/machine/break_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace knot_utm {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kShortest = 1e-3;  // [s]

Exposure at(double fraction) { return {fraction, 0, BreakLimit::kForce, 600.0 * fraction}; }

/// Follows the tensions that steps would end with, each over what the rod bears, as the machine does: a step that is
/// refused is tried again at half its length, in which the tension rises by half, as far as `least` [s].
struct Followed {
  double parted_at = 0.0;  ///< over the strength; 0: it is whole
  std::string refused;     ///< why the shortest step was
};

Followed follow(const std::vector<double>& fractions, double dt, double least) {
  BreakWatch watch(kShortest, at(0.0));
  double before = 0.0;
  for (const double fraction : fractions) {
    double reached = fraction, tried = dt;
    std::string why = watch.refuse(at(reached), tried);
    while (!why.empty()) {
      if (tried < least) return {0.0, why};
      tried *= 0.5;
      reached = before + 0.5 * (reached - before);
      why = watch.refuse(at(reached), tried);
    }
    if (watch.judge(at(reached), tried)) return {reached, ""};
    before = reached;
  }
  return {};
}

TEST(BreakWatch, ARodPartsAtItsStrengthHoweverBrittleItIs) {
  EXPECT_EQ(follow({0.2, 0.6, 0.9}, 0.3, 1e-7).parted_at, 0.0);
  EXPECT_EQ(follow({0.2, 0.6, 1.0}, 0.3, 1e-7).parted_at, 1.0);
  // A step that is 64 times too long is cut until it leads to the strength, or just below it, from where others go on.
  const Followed brittle = follow(std::vector<double>(20, 64.0), 0.3, 1e-7);
  EXPECT_GE(brittle.parted_at, 1.0);
  EXPECT_LE(brittle.parted_at, 1.001);
  EXPECT_THAT(brittle.refused, IsEmpty());
}

/// As of a loop that a roller ran into: whatever the tension was before, and however short the step is.
TEST(BreakWatch, NoStepLeadsToAMultipleOfTheStrength) {
  for (const double before : {0.0, 0.3, 0.6, 0.99})
    for (const double dt : {0.3, 1e-3, 1.6e-7}) {
      const std::string why = BreakWatch(kShortest, at(before)).refuse(at(1500.0), dt);
      EXPECT_THAT(why, HasSubstr("the tension would jump from")) << before << ' ' << dt;
      EXPECT_THAT(why, HasSubstr("to 1500 times what the rod bears"));
    }
  EXPECT_THAT(BreakWatch(kShortest, at(0.9)).refuse(at(1.5), 1.6e-7), IsEmpty()) << "a knot that lets go";
}

TEST(BreakWatch, AShapeThatWasDrawnBeyondItsStrengthPartsAtOnce) {
  BreakWatch watch(kShortest, at(3.0));
  EXPECT_THAT(watch.refuse(at(2.9), 0.3), IsEmpty());
  EXPECT_TRUE(watch.judge(at(2.9), 0.3));
}

TEST(BreakWatch, TheNextStepEndsWhereTheRodParts) {
  BreakWatch watch(kShortest, at(0.0));
  ASSERT_FALSE(watch.judge(at(0.4), 0.2));
  ASSERT_FALSE(watch.judge(at(0.8), 0.2));
  EXPECT_NEAR(watch.next(), 0.1, 1e-12);
  ASSERT_FALSE(watch.judge(at(0.999999), 0.1));
  EXPECT_EQ(watch.next(), kShortest);
}

TEST(BreakWatch, NoRodPartsByTensionWhileItsGripsArePressedTogether) {
  EXPECT_THAT(not_by_tension(at(1.0), -8.9e5, -9e5), HasSubstr("pressed together by 890000 N"));
  EXPECT_THAT(not_by_tension(at(1.0), 600.0, 600.0), IsEmpty());
  EXPECT_THAT(not_by_tension(at(1.0), -12.0, 600.0), IsEmpty()) << "under a weight along +z";
  EXPECT_THAT(not_by_tension(at(1.0), 600.0, -12.0), IsEmpty()) << "under its own weight";
  EXPECT_THAT(not_by_tension(at(1.0), -1e-6, -2e-6), IsEmpty()) << "a loop that parts while it is tied";
  // A rod that buckles parts where it is bent most.
  EXPECT_THAT(not_by_tension({1.0, 0, BreakLimit::kStrain, 0.2}, -3.0, -3.0), IsEmpty());
}

}  // namespace
}  // namespace knot_utm
