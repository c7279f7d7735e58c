#include "knot_utm/machine/load_control.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace knot_utm {
namespace {

constexpr double kPeriod = 0.1, kFastest = 0.01;  // [s], [m/s]

/// A spring, and how its load is led.
struct Spring {
  double stiffness;
  Sample now = {};
  LoadControl control = {};

  void step(double wanted) {
    now.displacement += kPeriod * control.speed(now, wanted, kPeriod, kFastest);
    now.load = stiffness * now.displacement;
  }
};

TEST(LoadControl, KnowsASpringAfterOneStepAndThenMeetsEveryLoad) {
  Spring spring{1e4};
  spring.step(1.0);
  for (int n = 2; n < 50; ++n) {
    spring.step(n);
    EXPECT_NEAR(spring.now.load, n, 1e-12 * n);
  }
}

TEST(LoadControl, IsNeverFasterThanTheCrosshead) {
  Spring soft{1.0};
  double before = 0.0;
  for (int n = 1; n < 50; ++n) {
    soft.step(n);
    EXPECT_LE(std::abs(soft.now.displacement - before), kPeriod * kFastest * (1.0 + 1e-12));
    before = soft.now.displacement;
  }
}

TEST(LoadControl, CatchesUpWithASpringThatTurnsSoft) {
  Spring spring{1e6};
  for (int n = 1; n < 10; ++n) spring.step(n);
  spring.stiffness = 1e4;
  spring.now.displacement = spring.now.load / spring.stiffness;
  spring.control.begin();
  for (int n = 10; n < 40; ++n) spring.step(n);
  EXPECT_NEAR(spring.now.load, 39.0, 1e-9);
}

/// Where the load no longer rises with the crosshead the estimate halves at every step, until the crosshead goes as
/// fast as it may.
TEST(LoadControl, RunsAfterALoadThatDoesNotRise) {
  LoadControl control;
  Sample now;
  double speed = control.speed(now, 1.0, kPeriod, kFastest);
  EXPECT_GT(speed, 0.0);
  now.displacement += kPeriod * speed;
  now.load = 0.5;
  for (int n = 0; n < 40; ++n) {
    speed = control.speed(now, 1.0, kPeriod, kFastest);
    now.displacement += kPeriod * speed;
  }
  EXPECT_EQ(speed, kFastest);
}

TEST(LoadControl, GoesBackWhereTheLoadIsTooLarge) {
  Spring spring{1e4};
  for (int n = 1; n < 10; ++n) spring.step(n);
  spring.step(2.0);
  EXPECT_NEAR(spring.now.load, 2.0, 1e-12);
}

}  // namespace
}  // namespace knot_utm
