// A figure-eight knot that stops a rod in a hole flips, because friction at the surface twists its strands (Johanns and
// Reis). Loads are those of coarse edges; `scripts/bench capsizing` has converged ones.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "knot_utm/rod/rod.hpp"
#include "knot_utm/topology/knot_invariants.hpp"
#include "sim/stopper_knot.hpp"

namespace knot_utm {
namespace {

constexpr double kEdge = 2.0 / 3.0;
constexpr double kFarthest = 70.0;

StopperKnot::Options coarse() {
  StopperKnot::Options out;
  out.edge = kEdge;
  return out;
}

double largest_force(const StopperKnot& scene) {
  double out = 0.0;
  for (const StopperKnot::Reading& one : scene.readings) out = std::max(out, one.force);
  return out;
}

KnotPolynomial knot_of(const StopperKnot& scene) {
  return alexander_polynomial(closed_far_away(scene.stepper->state().position, Vec3::UnitZ()));
}

/// Its mirror image twists the strand the other way, and flips at the same load.
TEST(Capsizing, WithTheCoupleAFigureEightTwistsFlipsAndStaysAFigureEight) {
  const KnotPolynomial figure_eight = {-1, 3, -1};
  StopperKnot scene(coarse());
  ASSERT_EQ(knot_of(scene), figure_eight);
  scene.tie();
  const auto flip = scene.pull_until_it_flips(kFarthest);
  ASSERT_TRUE(flip);
  const StopperKnot::Reading &before = scene.readings[flip->before], &after = scene.readings[flip->after];
  EXPECT_GT(before.force, 2.7);
  EXPECT_LT(before.force, 3.7);
  EXPECT_LT(after.force, 0.9 * before.force);
  EXPECT_GT(after.passed - before.passed, 4.0) << "rod that passes the hole at once";
  EXPECT_GT(before.twisting, 0.5);
  EXPECT_EQ(knot_of(scene), figure_eight);

  StopperKnot::Options options = coarse();
  options.mirrored = true;
  StopperKnot mirrored(options);
  mirrored.tie();
  const double torque = scene.readings.front().torque;  // of the clamp as the tail has been let go
  EXPECT_GT(std::abs(torque), 5e-3);
  EXPECT_NEAR(mirrored.readings.front().torque, -torque, 0.05 * std::abs(torque));
  const auto flipped = mirrored.pull_until_it_flips(kFarthest);
  ASSERT_TRUE(flipped);
  EXPECT_NEAR(mirrored.readings[flipped->before].force, before.force, 0.02 * before.force);
}

TEST(Capsizing, WithoutTheCoupleItNeitherTwistsNorFlipsAtAHigherLoad) {
  StopperKnot::Options options = coarse();
  options.couple = 0.0;
  StopperKnot scene(options);
  scene.tie();
  EXPECT_FALSE(scene.pull_until_it_flips(kFarthest));
  EXPECT_GT(largest_force(scene), 5.0);
  EXPECT_LT(scene.readings.back().twisting, 0.01);
}

}  // namespace
}  // namespace knot_utm
