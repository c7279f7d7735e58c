#include "sim/capstan.hpp"

#include <gtest/gtest.h>

#include "reference.hpp"

namespace knot_utm {
namespace {

class R8Capstan : public testing::TestWithParam<std::pair<double, double>> {};

TEST_P(R8Capstan, FormulaIsTheReferences) {
  const auto [t1, expected] = GetParam();
  EXPECT_NEAR(elastic_capstan(t1, Capstan::kMu, 2.0 * M_PI), expected, 5e-4);
}

TEST_P(R8Capstan, SlidesAtTheElasticRatio) {
  // Edges of rho/10; the error, second order in their length, passes 1 % at rho/5.
  const auto [t1, expected] = GetParam();
  Capstan scene(t1, {});
  hold_against("R8 capstan, T1 rho^2/B = " + std::to_string(std::lround(t1)) + ": T2/T1", expected, scene.ratio(),
               0.01);
}

TEST_P(R8Capstan, CoarseEdgesKeepTheRatio) {
  // Points of integration stand on the arc of the rod's own length, so that even a quarter of a radian an edge leaves
  // no lever-arm error; points on the spline itself would be 2 % off at 24 edges a turn.
  const auto [t1, expected] = GetParam();
  for (const double edges_a_turn : {24.0, 48.0}) {
    Capstan::Options options;
    options.edges_a_turn = edges_a_turn;
    Capstan scene(t1, options);
    EXPECT_NEAR(scene.ratio(), expected, 0.005 * expected) << edges_a_turn;
  }
}

TEST_P(R8Capstan, ARollerThatIsDrivenUnderARestingRodDragsAtTheSameRatio) {
  const auto [t1, expected] = GetParam();
  Capstan scene(t1, {});
  scene.by_roller = true;
  hold_against("R8 the same, the roller driven: T2/T1, T1 rho^2/B = " + std::to_string(std::lround(t1)), expected,
               scene.ratio(), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Loads, R8Capstan,
                         testing::Values(std::pair{2.0, 5.319}, std::pair{10.0, 6.305}, std::pair{50.0, 6.527},
                                         std::pair{1000.0, 6.583}),
                         [](const auto& load) { return "T" + std::to_string(std::lround(load.param.first)); });

/// Whatever mu, as nothing but the rod acts on it: the tension is the same on both sides, and it turns with the rod.
/// What is left, 1e-4, is friction along the axis, on which the helix walks and the roller does not.
TEST(AFreeRoller, TurnsWithTheRodAndTakesNothingFromItsTension) {
  for (const double t1 : {10.0, 1000.0}) {
    Capstan scene(t1, {});
    const double rho = scene.boundary.rollers[0].radius + Capstan::kRadius;
    scene.boundary.rollers[0].inertia = 1e-3;
    EXPECT_NEAR(scene.ratio(), 1.0, 3e-4) << t1;
    const double from = scene.stepper->readings().roller_turn(0).angle;
    scene.pull_by(0.5, 0.01);
    const double tilt = std::hypot(1.0, Capstan::kPitch / (2.0 * M_PI));  // of the helix against the roller's turn
    EXPECT_NEAR(scene.stepper->readings().roller_turn(0).angle - from, 0.5 / rho / tilt, 2e-3 * 0.5) << t1;
    EXPECT_LT(std::abs(scene.stepper->readings().roller_moment(0)[0]), 1e-5 * t1 * rho);
  }
}

}  // namespace
}  // namespace knot_utm
