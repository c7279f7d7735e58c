// How the crosshead is led to a load: that which a program asks for, and the little one at which slack is taken up,
// whatever the specimen is like and however large the steps are.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "knot_utm/program/course.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/tying/tied_loop.hpp"

namespace knot_utm {
namespace {

constexpr double kPeriod = 0.1, kFastest = 0.01;  // [s], [m/s]

/// A spring, and how its load is led.
struct Spring {
  double stiffness;
  Sample now = {};
  LoadControl control = {};

  void step(double wanted) {
    now.displacement += kPeriod * control.following(now, wanted, kPeriod, kFastest);
    now.force_upper = stiffness * now.displacement;
  }
};

TEST(LoadControl, CatchesUpWithASpringThatTurnsSoft) {
  Spring spring{1e6};
  for (int n = 1; n < 10; ++n) spring.step(n);
  spring.stiffness = 1e4;
  spring.now.displacement = spring.now.force_upper / spring.stiffness;
  spring.control.begin();
  for (int n = 10; n < 40; ++n) spring.step(n);
  EXPECT_NEAR(spring.now.force_upper, 39.0, 1e-9);
}

/// Where the load no longer rises with the crosshead the estimate halves at every step, until the crosshead goes as
/// fast as it may.
TEST(LoadControl, RunsAfterALoadThatDoesNotRise) {
  LoadControl control;
  Sample now;
  double speed = control.following(now, 1.0, kPeriod, kFastest);
  EXPECT_GT(speed, 0.0);
  now.displacement += kPeriod * speed;
  now.force_upper = 0.5;
  for (int n = 0; n < 40; ++n) {
    speed = control.following(now, 1.0, kPeriod, kFastest);
    now.displacement += kPeriod * speed;
  }
  EXPECT_EQ(speed, kFastest);
}

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
