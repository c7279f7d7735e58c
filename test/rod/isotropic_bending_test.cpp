#include "knot_utm/rod/isotropic_bending.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "rod/isotropic_bending_local.hpp"

namespace knot_utm {
namespace {

constexpr double kStiffness = 4.3e-5;
constexpr double kVoronoi = 3e-3;

using Edges = Eigen::Matrix<double, 6, 1>;

/// Two edges of unequal length that turn by an angle [rad].
Edges turn(double angle) {
  const Vec3 t_e = Vec3(1.0, -2.0, 0.5).normalized();
  const Vec3 n = t_e.cross(Vec3(0.2, 0.3, 1.0)).normalized();
  Edges edges;
  edges.head<3>() = 2.5e-3 * t_e;
  edges.tail<3>() = 3.4e-3 * (std::cos(angle) * t_e + std::sin(angle) * n);
  return edges;
}

IsotropicBendingLocal at(const Eigen::VectorXd& x) {
  return isotropic_bending(kStiffness, kVoronoi, x.head<3>(), x.tail<3>());
}

struct IsotropicBendingBy : testing::TestWithParam<double> {
  Edges edges = turn(GetParam());
};

TEST_P(IsotropicBendingBy, CheapPathAgrees) {
  const IsotropicBendingLocal full = at(edges);
  const IsotropicBendingGradient cheap =
      isotropic_bending_gradient(kStiffness, kVoronoi, edges.head<3>(), edges.tail<3>());
  EXPECT_NEAR(cheap.energy, full.energy, 1e-14 * full.energy);
  EXPECT_LT((cheap.gradient_e - full.gradient_e).norm(), 1e-13 * full.gradient_e.norm() + 1e-15);
  EXPECT_LT((cheap.gradient_f - full.gradient_f).norm(), 1e-13 * full.gradient_f.norm() + 1e-15);
}

INSTANTIATE_TEST_SUITE_P(Angles, IsotropicBendingBy, testing::Values(0.0, 1e-5, 0.1, 1.0, 2.0, 2.8));

}  // namespace
}  // namespace knot_utm
