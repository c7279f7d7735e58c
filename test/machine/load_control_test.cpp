#include "knot_utm/record/load_control.hpp"

#include <gtest/gtest.h>

#include "knot_utm/record/sample.hpp"

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

/// Over a way that is none, the change of the load is rounding or what the solver left.
TEST(LoadControl, LearnsNothingFromStandingStill) {
  LoadControl control;
  Sample now;
  control.following(now, 1.0, kPeriod, kFastest);
  now.displacement = 1e-4;
  now.force_upper = 1.0;
  control.following(now, 1.0, kPeriod, kFastest);
  now.displacement += 1e-12;
  now.force_upper = 0.9;
  const double speed = control.following(now, 1.0, kPeriod, kFastest);
  EXPECT_NEAR(speed, 0.1 / (0.5e4 * kPeriod), 1e-12);
}

}  // namespace
}  // namespace knot_utm
