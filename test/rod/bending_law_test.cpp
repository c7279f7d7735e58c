// Bending laws: moment and tangent are derivatives of W, and what is remembered agrees with them.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "knot_utm/rod/bending_laws.hpp"
#include "knot_utm/rod/material.hpp"

namespace knot_utm {
namespace {

constexpr double kYield = 2.0, kHardening = 0.2;  // [1/m], [-]

constexpr double kOwnNumbers[] = {4.0};  // T_max [N]

BendingNode node(const Eigen::Vector2d& bend) { return {3.0, 0.1, bend, {0.05, -0.02}, 0.3, kOwnNumbers}; }

/// From well below yield, 0.2 of bend, to far beyond it.
std::vector<Eigen::Vector2d> bends() {
  std::vector<Eigen::Vector2d> out;
  for (const double size : {0.01, 0.15, 0.25, 0.6, 2.0})
    for (const double angle : {0.0, 0.8, 2.5, 4.0})
      out.emplace_back(node({0.0, 0.0}).natural + size * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  return out;
}

template <typename Law>
Law law();
template <>
ElasticBending law() {
  return {};
}
template <>
PlasticBending law() {
  return {kYield, kHardening};
}

/// Of a rod with k_b 3 N m2 and h 5 mm, whose M_y is 4.8 N m + 0.15 m T_max.
FrictionalBending frictional() {
  RodMaterial material;
  material.radius = 0.005;
  material.bending_stiffness = 3.0;
  material.bending.set("stick_ratio", 20.0);
  material.bending.set("friction_moment", 0.008);
  material.bending.set("compaction", 30.0);
  return FrictionalBending::of(material);
}
template <>
FrictionalBending law() {
  return frictional();
}

template <typename Law>
struct BendingLaw : testing::Test {
  Law law = knot_utm::law<Law>();
};
using Laws = testing::Types<ElasticBending, PlasticBending, FrictionalBending>;
TYPED_TEST_SUITE(BendingLaw, Laws);

TYPED_TEST(BendingLaw, MomentAndTangentAreDerivatives) {
  constexpr double kStep = 1e-6;
  // The differences err by the square of the step over the bend at yield, which is 0.008 at least.
  const double stiffest = this->law.respond(node(node({0.0, 0.0}).natural)).tangent.norm();
  for (const Eigen::Vector2d& bend : bends()) {
    const BendingResponse here = this->law.respond(node(bend));
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(k);
      const BendingResponse on = this->law.respond(node(bend + step)), back = this->law.respond(node(bend - step));
      EXPECT_NEAR((on.energy - back.energy) / (2.0 * kStep), here.moment[k], 1e-3 * stiffest * kStep);
      for (int l = 0; l < 2; ++l)
        EXPECT_NEAR((on.moment[l] - back.moment[l]) / (2.0 * kStep), here.tangent(l, k), 1e-7 * stiffest);
    }
  }
}

/// A second spring holds at the solution: k kappa + k_y xi = 0 at kappa = 0. Tangents jump from one side on which it
/// slides to the other for ever, by k_y/k times its bend at yield. Newton's method with the linear model is there after
/// the first jump.
TEST(YieldingBend, HoldsAfterTrialsHaveJumpedOverIt) {
  const YieldingBend law{1.0, 20.0, 0.01};
  BendingNode node{1.0, 1.0, {0.05, 0.02}, {0.0, 0.0}};
  for (int iteration = 0; iteration < 2; ++iteration) {
    ASSERT_GT(node.bend.norm(), law.yield) << "slides";
    const BendingResponse here = law.respond(node);
    node.before = node.bend - node.natural;
    node.bend -= here.tangent.ldlt().solve(here.moment + here.beyond);
  }
  EXPECT_LT(node.bend.norm(), 1e-12 * law.yield);
}

/// What the last trial was is no matter of the moment or of the energy, and none of the tangent where the direction has
/// stayed.
TEST(YieldingBend, RespondsTheSameWhateverTheLastTrialWas) {
  const YieldingBend law{1.0, 20.0, 0.01};
  BendingNode node{1.0, 1.0, {0.05, 0.02}, {0.0, 0.0}};
  const BendingResponse first = law.respond(node);
  node.before = 3.0 * node.bend;
  const BendingResponse same = law.respond(node);
  node.before = -node.bend;
  const BendingResponse turned = law.respond(node);
  EXPECT_EQ(same.tangent, first.tangent);
  EXPECT_EQ(same.beyond, Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(turned.moment, first.moment);
  EXPECT_EQ(turned.energy, first.energy);
  EXPECT_LT((turned.moment + turned.beyond - 21.0 * node.bend).norm(), 1e-15) << "as if it held";
}

/// After the step the same bend, at once, needs the same moment and stores what was said of it. W was that and what was
/// dissipated.
TYPED_TEST(BendingLaw, RemembersWhatItsMomentIsOf) {
  for (const Eigen::Vector2d& bend : bends()) {
    const BendingNode before = node(bend);
    const BendingResponse response = this->law.respond(before);
    const BendingMemory memory = this->law.remember(before);
    EXPECT_GE(memory.dissipated, 0.0);
    BendingNode after = before;
    after.natural = memory.natural;
    const BendingResponse again = this->law.respond(after);
    EXPECT_LT((again.moment - response.moment).norm(), 1e-13 * response.moment.norm());
    const double rounding = 1e-13 * response.energy;
    EXPECT_NEAR(again.energy, memory.stored, rounding);
    EXPECT_NEAR(response.energy, memory.stored + memory.dissipated, rounding);
  }
}

/// Bent to and fro between +kappa and -kappa, it dissipates 4 (1 - r) k_b kappa_y (kappa - kappa_y) lbar a cycle.
TEST(PlasticBending, DissipatesTheLoopOfACycle) {
  const PlasticBending law{kYield, kHardening};
  const double lbar = 0.1, k_b = 3.0, kappa = 7.0;
  BendingNode strip{k_b, lbar, {0.0, 0.0}, {0.0, 0.0}};
  double dissipated = 0.0;
  for (int turn = 0; turn < 7; ++turn) {
    strip.bend[0] = (turn % 2 == 0 ? kappa : -kappa) * lbar;
    const BendingMemory memory = law.remember(strip);
    if (turn >= 1 && turn <= 6) dissipated += memory.dissipated;
    strip.natural = memory.natural;
  }
  const double loop = 4.0 * (1.0 - kHardening) * k_b * kYield * (kappa - kYield) * lbar;
  EXPECT_NEAR(dissipated, 3.0 * loop, 1e-12 * loop);
}

}  // namespace
}  // namespace knot_utm
