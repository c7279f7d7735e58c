// Stretching laws: tension and slope are derivatives of the energy, and at rest all laws have the same stiffness.

#include <gtest/gtest.h>

#include <cmath>

#include "knot_utm/rod/energy.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/rod/stretching.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "rod/finite_difference.hpp"
#include "rod/own_laws.hpp"

namespace knot_utm {
namespace {

constexpr double kStiffness = 7.0, kRest = 0.3;

StretchedEdge edge(double stretch) { return {kStiffness, kRest, stretch}; }

template <typename Law>
struct StretchingLaw : testing::Test {
  Law law;
};
using Laws = testing::Types<LinearStretching, NeoHookeanStretching>;
TYPED_TEST_SUITE(StretchingLaw, Laws);

TYPED_TEST(StretchingLaw, TensionAndSlopeAreDerivatives) {
  constexpr double kStep = 1e-5;
  for (const double stretch : {0.4, 0.9, 0.999, 1.0, 1.001, 1.1, 1.5, 3.0}) {
    const StretchingResponse here = this->law.respond(edge(stretch));
    const StretchingResponse on = this->law.respond(edge(stretch + kStep)),
                             back = this->law.respond(edge(stretch - kStep));
    // The third derivative of the energy is at most k_s 2/0.4^4, and that of the tension k_s 8/0.4^5.
    EXPECT_NEAR((on.energy - back.energy) / (2.0 * kStep) / kRest, here.tension, 1e-8 * kStiffness);
    EXPECT_NEAR((on.tension - back.tension) / (2.0 * kStep), here.slope, 2e-7 * kStiffness);
  }
}

TYPED_TEST(StretchingLaw, IsAtRestWithItsStiffness) {
  const StretchingResponse rest = this->law.respond(edge(1.0));
  EXPECT_EQ(rest.energy, 0.0);
  EXPECT_EQ(rest.tension, 0.0);
  EXPECT_NEAR(rest.slope, kStiffness, 1e-15 * kStiffness);
  constexpr double kStrain = 1e-6;
  for (const double strain : {-kStrain, kStrain}) {
    const StretchingResponse near = this->law.respond(edge(1.0 + strain));
    EXPECT_NEAR(near.tension, kStiffness * strain, 2.0 * kStiffness * strain * strain);
    EXPECT_NEAR(near.energy, 0.5 * kStiffness * strain * strain * kRest, kStiffness * kRest * std::pow(kStrain, 3));
  }
}

TYPED_TEST(StretchingLaw, StrainIsTheInverseOfTheTension) {
  for (const double stretch : {1.0, 1.0 + 1e-9, 1.001, 1.1, 1.5, 3.0, 50.0}) {
    const double tension = this->law.respond(edge(stretch)).tension;
    // A rounding of the tension, which is as large as k_s times the strain or less.
    EXPECT_NEAR(this->law.strain(kStiffness, tension), stretch - 1.0, 1e-14 * stretch);
  }
}

TYPED_TEST(StretchingLaw, HasNoTensionWherePartedFromItsStiffness) {
  const StretchingResponse parted = this->law.respond({0.0, kRest, 1.7});
  EXPECT_EQ(parted.tension, 0.0);
  EXPECT_EQ(parted.slope, 0.0);
}

/// An edge of a rod, from the law of its own, from the rod, and by differences.
TYPED_TEST(StretchingLaw, OfAnEdgeHasTheDerivativesOfItsEnergyAndIsTheRods) {
  constexpr double kStep = 1e-4;
  RodProperties rod = make_rod(Material(), Eigen::VectorXd::Constant(1, kRest));
  rod.material.stretching_stiffness = kStiffness;
  set_law(rod, StretchingLaws(this->law));
  const auto of = [&](const Eigen::VectorXd& e) { return stretching(this->law, kStiffness, kRest, Vec3(e)); };
  for (const double stretch : {0.8, 0.99, 1.0, 1.01, 1.5}) {
    const Eigen::VectorXd edge = stretch * kRest * Vec3(0.3, -0.5, 0.8).normalized();
    const StretchingLocal local = of(edge);
    const Eigen::VectorXd gradient =
        finite_difference_gradient([&](const Eigen::VectorXd& e) { return of(e).energy; }, edge, kStep);
    EXPECT_LT((local.gradient - gradient).norm(), 1e-7 * kStiffness * (std::abs(stretch - 1.0) + 1e-6));
    const auto slope = [&](const Eigen::VectorXd& e) -> Eigen::VectorXd { return of(e).gradient; };
    EXPECT_LT(relative_difference(local.hessian, finite_difference(slope, edge, kStep)), 1e-8);
    Points position = Points::Zero(3, 2);
    position.col(1) = edge;
    const StretchingResponse response = respond(rod, 0, stretched_edge(rod, position, 0));
    EXPECT_NEAR(response.energy, local.energy, 1e-14 * local.energy);
    EXPECT_NEAR(local.gradient.dot(edge.normalized()), response.tension, 1e-14 * kStiffness);
  }
}

/// At twice its length: T = k_s/3 (2 - 1/4), W = k_s/6 (4 + 1 - 3).
TEST(NeoHookeanStretching, OfABarAtTwiceItsLength) {
  const StretchingResponse twice = NeoHookeanStretching().respond(edge(2.0));
  EXPECT_NEAR(twice.tension, kStiffness / 3.0 * 1.75, 1e-14);
  EXPECT_NEAR(twice.energy, kRest * kStiffness / 6.0 * 2.0, 1e-14);
  EXPECT_NEAR(twice.slope, kStiffness / 3.0 * 1.25, 1e-14);
}

Material material() {
  Material m;
  m.radius = 1e-2;
  m.density = 1000.0;
  m.stretching_stiffness = 50.0;
  m.bending_stiffness = 2.0;
  m.twisting_stiffness = 1.5;
  return m;
}

/// A circular arc of n edges of length l that turns by `angle` at every node.
RodState arc(Eigen::Index n, double l, double angle) {
  RodState state;
  state.position = Points::Zero(3, n + 1);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double direction = angle * static_cast<double>(j);
    state.position.col(j + 1) = state.position.col(j) + l * Vec3(std::cos(direction), std::sin(direction), 0.0);
  }
  return state;
}

/// Every node of a rod that is wound to a radius turns by its Voronoi length over it, however long its edges are.
TEST(Energy, OfAnArcIsExactWhateverItsEdges) {
  constexpr double kRadius = 0.4;
  Eigen::VectorXd rest(6);
  rest << 0.1, 0.04, 0.16, 0.16, 0.02, 0.1;
  const RodProperties rod = make_rod(material(), rest);
  RodState state;
  state.position = Points::Zero(3, rod.nodes());
  double direction = 0.0;
  for (Eigen::Index j = 0; j < rod.edges(); ++j) {
    if (j > 0) direction += rod.voronoi_length[j] / kRadius;
    state.position.col(j + 1) = state.position.col(j) + rest[j] * Vec3(std::cos(direction), std::sin(direction), 0.0);
  }
  const double bent_length = rod.voronoi_length.segment(1, rod.edges() - 1).sum();
  const double expected = 0.5 * 2.0 / (kRadius * kRadius) * bent_length;
  EXPECT_NEAR(elastic_energy(rod, state).bending, expected, 1e-9 * expected);
  initialise_frames(&state);
  EXPECT_NEAR(elastic_energy(rod, state).bending, expected, 1e-9 * expected);
}

TEST(Energy, OfTwistIsHalfMomentTimesAngle) {
  const RodProperties rod = make_rod(material(), Eigen::VectorXd::Constant(8, 0.1));
  RodState state = arc(8, 0.1, 0.0);
  initialise_frames(&state);
  state.twist.setLinSpaced(0.0, 1.4);
  const double moment = 1.5 * 0.2 / 0.1;
  EXPECT_NEAR(elastic_energy(rod, state).twisting, 0.5 * moment * 1.4, 1e-12);
}

Eigen::Vector2d bend_of(const RodProperties& rod, const RodState& state, Eigen::Index i) {
  const InnerNode node = inner_node(rod, state, i);
  return material_curvature(node.e, node.f, node.on_e, node.on_f);
}

TEST(Energy, VanishesInTheNaturalShape) {
  RodProperties rod = make_rod(material(), Eigen::VectorXd::Constant(8, 0.1));
  RodState state = arc(8, 0.1, 0.3);
  initialise_frames(&state);
  state.natural_curvature.resize(2, 7);
  for (Eigen::Index i = 1; i < 8; ++i) state.natural_curvature.col(i - 1) = bend_of(rod, state, i);
  EXPECT_NEAR(elastic_energy(rod, state).total(), 0.0, 1e-20);
}

TEST(Energy, TensionIsPositiveWhereTheEdgeIsLonger) {
  const RodProperties rod = make_rod(material(), Eigen::VectorXd::Constant(8, 0.1));
  EXPECT_LT((edge_tension(rod, arc(8, 0.12, 0.3)).array() - 10.0).abs().maxCoeff(), 1e-12);
  EXPECT_LT((edge_tension(rod, arc(8, 0.09, 0.3)).array() + 5.0).abs().maxCoeff(), 1e-12);
  EXPECT_NEAR(elastic_energy(rod, arc(8, 0.12, 0.3)).stretching, 8 * 0.5 * 50.0 * 0.1 * 0.04, 1e-12);
}

/// What is bent within its yield stores r/2 k kappa^2 + (1 - r)/2 k (kappa - kappabar)^2, k = k_b/lbar, in every node.
TEST(Energy, OfBendingIsThatOfTheRodsLaw) {
  constexpr Eigen::Index kEdges = 8;
  constexpr double kLength = 0.1, kAngle = 0.3, kKept = 0.2, kHardening = 0.25;
  RodProperties rod = make_rod(material(), Eigen::VectorXd::Constant(kEdges, kLength));
  set_law(rod, PlasticBending{10.0 * kAngle / kLength, kHardening});
  RodState state = arc(kEdges, kLength, kAngle);
  initialise_frames(&state);
  state.natural_curvature = Eigen::Matrix2Xd::Zero(2, kEdges - 1);
  const auto expected = [&](double kept) {
    const double each = kHardening * kAngle * kAngle + (1.0 - kHardening) * std::pow(kAngle - kept, 2);
    return 0.5 * 2.0 / kLength * each * (kEdges - 1);
  };
  EXPECT_NEAR(elastic_energy(rod, state).bending, expected(0.0), 1e-9 * expected(0.0));
  for (Eigen::Index i = 1; i < kEdges; ++i)
    state.natural_curvature.col(i - 1) = kKept / kAngle * bend_of(rod, state, i);
  EXPECT_NEAR(elastic_energy(rod, state).bending, expected(kKept), 1e-9 * expected(kKept));
}

}  // namespace
}  // namespace knot_utm
