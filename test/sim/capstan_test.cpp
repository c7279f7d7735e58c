#include "sim/capstan.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "reference.hpp"

namespace knot_utm {
namespace {

const std::pair<double, double> kReferences[] = {{2.0, 5.319}, {10.0, 6.305}, {50.0, 6.527}, {1000.0, 6.583}};

/// Edges of rho/10; the error, second order in their length, passes 1 % at rho/5.
TEST(R8Capstan, SlidesAtTheElasticRatio) {
  for (const auto& [t1, expected] : kReferences) {
    EXPECT_NEAR(elastic_capstan(t1, Capstan::kMu, 2.0 * M_PI), expected, 5e-4);
    hold_against(formatted("R8 capstan, T1 rho^2/B = %g: T2/T1", t1), expected, Capstan(t1, {}).ratio(), 0.01);
  }
}

/// Points of integration stand on the arc of the rod's own length, so that even a quarter of a radian an edge leaves no
/// lever-arm error; points on the spline itself would be 2 % off.
TEST(R8Capstan, CoarseEdgesKeepTheRatio) {
  Capstan::Options options;
  options.edges_a_turn = 24.0;
  for (const auto& [t1, expected] : kReferences) EXPECT_NEAR(Capstan(t1, options).ratio(), expected, 0.005 * expected);
}

/// Whatever mu, as nothing but the rod acts on it: the tension is the same on both sides, and it turns with the rod.
/// What is left, 1e-4, is friction along the axis, on which the helix walks and the roller does not.
TEST(AFreeRoller, TurnsWithTheRodAndTakesNothingFromItsTension) {
  constexpr double kTension = 10.0;
  Capstan scene(kTension, {});
  const double rho = scene.boundary.rollers[0].radius + Capstan::kRadius;
  scene.boundary.rollers[0].inertia = 1e-3;
  EXPECT_NEAR(scene.ratio(), 1.0, 3e-4);
  const double from = scene.stepper->readings().roller_turn(0).angle;
  scene.pull_by(0.5, 0.01);
  const double tilt = std::hypot(1.0, Capstan::kPitch / (2.0 * M_PI));  // of the helix against the roller's turn
  EXPECT_NEAR(scene.stepper->readings().roller_turn(0).angle - from, 0.5 / rho / tilt, 2e-3 * 0.5);
  EXPECT_LT(std::abs(scene.stepper->readings().roller_moment(0)[0]), 1e-5 * kTension * rho);
}

}  // namespace
}  // namespace knot_utm
