#include "knot_utm/rod/stretching.hpp"

#include <gtest/gtest.h>

#include "rod/finite_difference.hpp"

namespace knot_utm {
namespace {

constexpr double kStiffness = 7.3e4;
constexpr double kRest = 3e-3;
constexpr double kStep = 1e-6;

struct StretchingOf : testing::TestWithParam<double> {
  Vec3 edge = GetParam() * kRest * Vec3(0.3, -0.5, 0.8).normalized();
};

TEST_P(StretchingOf, GradientIsThatOfTheEnergy) {
  const auto energy = [](const Eigen::VectorXd& x) { return stretching(kStiffness, kRest, x).energy; };
  const Eigen::VectorXd expected = finite_difference_gradient(energy, edge, kStep);
  const double scale = kStiffness * (std::abs(GetParam() - 1.0) + 1e-6);
  EXPECT_LT((stretching(kStiffness, kRest, edge).gradient - expected).norm(), 1e-7 * scale);
}

TEST_P(StretchingOf, HessianIsThatOfTheGradient) {
  const auto gradient = [](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return stretching(kStiffness, kRest, x).gradient;
  };
  EXPECT_LT(relative_difference(stretching(kStiffness, kRest, edge).hessian, finite_difference(gradient, edge, kStep)),
            1e-8);
}

TEST_P(StretchingOf, CheapPathAgrees) {
  const StretchingLocal full = stretching(kStiffness, kRest, edge);
  const StretchingGradient cheap = stretching_gradient(kStiffness, kRest, edge);
  EXPECT_NEAR(cheap.energy, full.energy, 1e-14 * full.energy);
  EXPECT_LT((cheap.gradient - full.gradient).norm(), 1e-13 * full.gradient.norm() + 1e-12);
  EXPECT_NEAR(full.gradient.dot(edge.normalized()), stretching_tension(kStiffness, kRest, edge), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(Stretches, StretchingOf, testing::Values(0.8, 0.99, 1.0, 1.01, 1.5));

TEST(Stretching, TenPercentIsATenthOfTheStiffness) {
  const StretchingLocal local = stretching(100.0, 2.0, Vec3(2.2, 0.0, 0.0));
  EXPECT_NEAR(local.energy, 0.5 * 100.0 * 2.0 * 0.01, 1e-13);
  EXPECT_NEAR(local.gradient.x(), 10.0, 1e-12);
}

}  // namespace
}  // namespace knot_utm
