// Slack that is taken up: where the crosshead stops, whatever the loop is like and however large the steps are.

#include "knot_utm/machine/take_up.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace knot_utm {
namespace {

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
  TakeUp taking(kTaut, kRadius);
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

TEST(TakeUp, StopsAtTheSameLoadInSoftAndStiffLoopsAtAnyStep) {
  for (const double stiffness : {200.0, 3e3, 3e4})
    for (const double slack : {0.0, 1e-3, 5e-3})
      for (const double step : {1e-3, 1.0 / 24.0, 1.0 / 6.0}) {
        const Taken taken = take_up({slack, stiffness}, step);
        ASSERT_TRUE(taken.done);
        EXPECT_NEAR(taken.load, kTaut, 0.2 * kTaut) << stiffness << " N/m, " << slack << " m, " << step << " s";
      }
}

TEST(TakeUp, SlackensALoopThatIsTautAlready) {
  const Taken taken = take_up({-2e-3, 1000.0}, 1.0 / 24.0);
  ASSERT_TRUE(taken.done);
  EXPECT_NEAR(taken.load, kTaut, 0.2 * kTaut);
  EXPECT_LE(taken.most, 0.0) << "it went further out first";
}

TEST(TakeUp, StandsWhereNoWayBackTakesTheLoadAway) {
  const Taken taken = take_up({0.0, 1000.0, 1.0}, 1.0 / 24.0);
  ASSERT_TRUE(taken.done);
  EXPECT_LT(taken.least, -2.9 * kRadius);
  EXPECT_GT(taken.least, -3.2 * kRadius);
}

TEST(TakeUp, StandsWhereKnotsSlideUnderLess) {
  const Taken taken = take_up({1.0, 1000.0, 0.0, 2.0}, 1.0 / 24.0);
  ASSERT_TRUE(taken.done);
  EXPECT_NEAR(2.0 * taken.way, 0.3 * kRadius, 2.0 * kSpeed / 24.0);
}

}  // namespace
}  // namespace knot_utm
