#include "knot_utm/rod/stretching.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "knot_utm/specimen/material.hpp"
#include "rod/finite_difference.hpp"
#include "rod/own_laws.hpp"

namespace knot_utm {
namespace {

constexpr double kStiffness = 7.3e4;
constexpr double kRest = 3e-3;
constexpr double kStep = 1e-6;

StretchingLocal of(const StretchingLaws& law, const Vec3& edge) {
  return std::visit([&](const auto& own) { return stretching(own, kStiffness, kRest, edge); }, law);
}

struct StretchingOf : testing::TestWithParam<std::tuple<double, StretchingLaws>> {
  double stretch = std::get<0>(GetParam());
  StretchingLaws law = std::get<1>(GetParam());
  Vec3 edge = stretch * kRest * Vec3(0.3, -0.5, 0.8).normalized();
};

TEST_P(StretchingOf, GradientIsThatOfTheEnergy) {
  const auto energy = [&](const Eigen::VectorXd& x) { return of(law, x).energy; };
  const Eigen::VectorXd expected = finite_difference_gradient(energy, edge, kStep);
  const double scale = kStiffness * (std::abs(stretch - 1.0) + 1e-6);
  EXPECT_LT((of(law, edge).gradient - expected).norm(), 1e-7 * scale);
}

TEST_P(StretchingOf, HessianIsThatOfTheGradient) {
  const auto gradient = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return of(law, x).gradient; };
  EXPECT_LT(relative_difference(of(law, edge).hessian, finite_difference(gradient, edge, kStep)), 1e-8);
}

TEST_P(StretchingOf, AnEdgeOfARodIsTheSame) {
  Material material;
  material.radius = material.density = 1.0;
  material.stretching_stiffness = kStiffness;
  RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(1, kRest));
  set_law(rod, law);
  Points position = Points::Zero(3, 2);
  position.col(1) = edge;
  const StretchingResponse response = respond(rod, stretched_edge(rod, position, 0));
  const StretchingLocal local = of(law, edge);
  EXPECT_NEAR(response.energy, local.energy, 1e-14 * local.energy);
  EXPECT_NEAR(local.gradient.dot(edge.normalized()), response.tension, 1e-10);
}

INSTANTIATE_TEST_SUITE_P(Stretches, StretchingOf,
                         testing::Combine(testing::Values(0.8, 0.99, 1.0, 1.01, 1.5),
                                          testing::Values(StretchingLaws(LinearStretching()),
                                                          StretchingLaws(NeoHookeanStretching()))));

TEST(Stretching, TenPercentIsATenthOfTheStiffness) {
  const StretchingLocal local = stretching(LinearStretching(), 100.0, 2.0, Vec3(2.2, 0.0, 0.0));
  EXPECT_NEAR(local.energy, 0.5 * 100.0 * 2.0 * 0.01, 1e-13);
  EXPECT_NEAR(local.gradient.x(), 10.0, 1e-12);
}

}  // namespace
}  // namespace knot_utm
