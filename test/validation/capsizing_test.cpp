// A figure-eight knot that stops a rod in a hole flips, because friction at the surface twists its strands (Johanns and
// Reis). Loads are those of coarse edges; doc/developers/benchmarks.md has converged ones.

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

struct Outcome {
  double torque = 0.0;      // of the clamp as the tail has been let go
  double flip_force = 0.0;  // 0: it does not flip
};

Outcome outcome_of(const StopperKnot::Options& options) {
  StopperKnot scene(options);
  scene.tie();
  const auto flip = scene.pull_until_it_flips(kFarthest);
  return {scene.readings.front().torque, flip ? scene.readings[flip->before].force : 0.0};
}

/// What the others are compared with.
const Outcome& reference() {
  static const Outcome out = outcome_of(coarse());
  return out;
}

KnotPolynomial knot_of(const StopperKnot& scene) {
  return alexander_polynomial(closed_far_away(scene.stepper->state().position, Vec3::UnitZ()));
}

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

TEST(Capsizing, ARodThatTwistsMoreEasilyFlipsEarlier) {
  StopperKnot::Options soft = coarse();
  soft.twisting *= 0.3;
  const double softer = outcome_of(soft).flip_force;
  EXPECT_GT(softer, 0.0);
  EXPECT_LT(softer, 0.75 * reference().flip_force);
}

TEST(Capsizing, ItsMirrorImageTwistsTheStrandTheOtherWayAndFlipsAtTheSameLoad) {
  StopperKnot::Options options = coarse();
  options.mirrored = true;
  const Outcome mirrored = outcome_of(options);
  EXPECT_GT(std::abs(reference().torque), 5e-3);
  EXPECT_NEAR(mirrored.torque, -reference().torque, 0.05 * std::abs(reference().torque));
  EXPECT_GT(mirrored.flip_force, 0.0);
  EXPECT_NEAR(mirrored.flip_force, reference().flip_force, 0.02 * reference().flip_force);
}

/// An overhand is not its own mirror image, and has no other shape to flip to: it rolls and slips by jerks.
TEST(Capsizing, AnOverhandSlipsAndKeepsItsShape) {
  StopperKnot::Options options = coarse();
  options.kind = StopperKnot::Kind::kOverhand;
  StopperKnot scene(options);
  scene.tie();
  EXPECT_FALSE(scene.pull_until_it_flips(20.0));
  EXPECT_LT(largest_force(scene), 1.0);
  EXPECT_GT(scene.readings.back().passed, 15.0);
}

}  // namespace
}  // namespace knot_utm
