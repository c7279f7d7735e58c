#include "knot_utm/rod/energy.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "rod/own_laws.hpp"

namespace knot_utm {
namespace {

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
  state.twist.setLinSpaced(0.0, 0.7);
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
