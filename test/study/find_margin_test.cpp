#include "knot_utm/study/find_margin.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "knot_utm/record/loading_steps.hpp"
#include "knot_utm/record/preparing_steps.hpp"
#include "rod/materials.hpp"

namespace knot_utm {
namespace {

TEST(Margin, IsTheShareBelowWhichTheKnotOpens) {
  for (const double critical : {0.26, 0.4, 0.65, 0.9, 0.999}) {
    std::vector<double> tried;
    const double fraction = fraction_until_it_opens([&](double factor) {
      tried.push_back(factor);
      return factor < critical;
    });
    EXPECT_EQ(tried.size(), 4u);
    EXPECT_NEAR((1.0 - fraction) / critical, 1.0, 0.1) << critical;
  }
}

TEST(Margin, OfAKnotThatHoldsEverywhereIsAtLeastTheMost) {
  int runs = 0;
  const double fraction = fraction_until_it_opens([&](double) {
    ++runs;
    return false;
  });
  EXPECT_EQ(fraction, Margin::kMost);
  EXPECT_EQ(runs, 1);
}

/// Polypropylene's knots hold with a friction of 0.55 and jump open with 0.5, at `draft` as at `normal`; its own is
/// 0.63. The search leaves a tenth of the friction.
TEST(Margin, OfPolypropyleneLiesWhereItsKnotsJumpOpen) {
  Method test;
  test.material = polypropylene();
  test.specimen.to_be_tied = true;
  test.specimen.preload = 50.0;
  PullStep pull;
  pull.until.extension = 0.12;
  test.program = {TieStep(), ReleaseStep(), MountStep(), BalanceStep(), pull};
  const Margin margin = find_margin(test, [] { return false; });
  ASSERT_TRUE(margin.friction) << margin.reason;
  EXPECT_GT(*margin.friction, 0.05);
  EXPECT_LT(*margin.friction, 0.3);
}

}  // namespace
}  // namespace knot_utm
