#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <functional>

#include "knot_utm/rod/bending.hpp"
#include "knot_utm/rod/isotropic_bending.hpp"
#include "knot_utm/rod/twisting.hpp"
#include "rod/finite_difference.hpp"
#include "rod/isotropic_bending_local.hpp"

namespace knot_utm {
namespace {

constexpr double kStep = 2e-4;

/// Three nodes, two edges and their reference directors in a base position. At any other position the reference frame
/// is the base frame, transported there in one go: positions and angles then determine the energy.
struct Base {
  StencilVector at;
  Vec3 d1_e, d1_f;

  Vec3 e(const StencilVector& x) const { return x.segment<3>(4) - x.segment<3>(0); }
  Vec3 f(const StencilVector& x) const { return x.segment<3>(8) - x.segment<3>(4); }
  Vec3 moved_d1_e(const StencilVector& x) const {
    return parallel_transport(d1_e, e(at).normalized(), e(x).normalized());
  }
  Vec3 moved_d1_f(const StencilVector& x) const {
    return parallel_transport(d1_f, f(at).normalized(), f(x).normalized());
  }
  Directors on_e(const StencilVector& x) const { return material_directors(e(x).normalized(), moved_d1_e(x), x[3]); }
  Directors on_f(const StencilVector& x) const { return material_directors(f(x).normalized(), moved_d1_f(x), x[7]); }
  double twist(const StencilVector& x) const {
    return x[7] - x[3] + reference_twist(moved_d1_e(x), e(x).normalized(), moved_d1_f(x), f(x).normalized());
  }
};

/// A bend of `angle` [rad] whose material frames are twisted by `twist` [rad] against each other.
Base make_base(double angle, double twist) {
  const Vec3 t_e = Vec3(1.0, -2.0, 0.5).normalized();
  const Vec3 n = t_e.cross(Vec3(0.2, 0.3, 1.0)).normalized();
  const Vec3 t_f = std::cos(angle) * t_e + std::sin(angle) * n;
  Base base;
  base.at.segment<3>(0) = Vec3(0.1, 0.2, -0.3);
  base.at.segment<3>(4) = base.at.segment<3>(0) + 0.8 * t_e;
  base.at.segment<3>(8) = base.at.segment<3>(4) + 1.3 * t_f;
  base.d1_e = std::cos(0.7) * n + std::sin(0.7) * t_e.cross(n);
  const Vec3 carried = parallel_transport(base.d1_e, t_e, t_f);
  base.d1_f = std::cos(0.4) * carried + std::sin(0.4) * t_f.cross(carried);
  base.at[3] = 0.3;
  base.at[7] = base.at[3] + twist - 0.4;
  return base;
}

using Scalar = std::function<double(const Eigen::VectorXd&)>;
using Vector = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

void expect_derivatives(const Base& base, const StencilLocal& local, const Scalar& energy, const Vector& gradient) {
  const double gradient_scale = local.gradient.norm() + 1e-3;
  EXPECT_LT((local.gradient - finite_difference_gradient(energy, base.at, kStep)).norm(), 1e-8 * gradient_scale);

  // The gradient follows the frame at the moved position, the energy's own derivative the base frame: they differ by
  // the area that the tangent sweeps, which is antisymmetric to first order.
  const Eigen::MatrixXd slope = finite_difference(gradient, base.at, kStep);
  EXPECT_LT(relative_difference(local.hessian, 0.5 * (slope + slope.transpose())), 1e-7);

  const Vector energy_slope = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return finite_difference_gradient(energy, x, 2e-3);
  };
  EXPECT_LT(relative_difference(local.hessian, finite_difference(energy_slope, base.at, 2e-3)), 1e-6);
  EXPECT_LT(relative_difference(local.hessian, local.hessian.transpose()), 1e-14);
}

struct Corner {
  double angle;
  double twist;
};

class StencilAt : public testing::TestWithParam<Corner> {
 protected:
  Base base = make_base(GetParam().angle, GetParam().twist);

  StencilLocal bend(const BendingInput& input, const StencilVector& x) const {
    return bending(input, base.e(x), base.f(x), base.on_e(x), base.on_f(x));
  }
  StencilLocal turn(const TwistingInput& input, const StencilVector& x) const {
    return twisting(input, base.e(x), base.f(x), base.twist(x));
  }
  void expect_bending(const BendingInput& input) const {
    expect_derivatives(
        base, bend(input, base.at), [&](const Eigen::VectorXd& x) { return bend(input, x).energy; },
        [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return bend(input, x).gradient; });
  }
  void expect_twisting(const TwistingInput& input) const {
    expect_derivatives(
        base, turn(input, base.at), [&](const Eigen::VectorXd& x) { return turn(input, x).energy; },
        [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return turn(input, x).gradient; });
  }
};

TEST_P(StencilAt, BendingDerivativesOfAStraightRod) { expect_bending({2.0, 1.05, {0.0, 0.0}}); }
TEST_P(StencilAt, BendingDerivativesOfACurvedRod) { expect_bending({2.0, 1.05, {0.4, -0.7}}); }
TEST_P(StencilAt, BendingDerivativesAtTheNaturalState) {
  const Eigen::Vector2d natural =
      material_curvature(base.e(base.at), base.f(base.at), base.on_e(base.at), base.on_f(base.at));
  EXPECT_LT(bend({2.0, 1.05, natural}, base.at).gradient.norm(), 1e-14);
  expect_bending({2.0, 1.05, natural});
}
TEST_P(StencilAt, TwistingDerivatives) { expect_twisting({1.5, 1.05}); }

INSTANTIATE_TEST_SUITE_P(BendsAndTwists, StencilAt,
                         testing::Values(Corner{0.0, 0.0}, Corner{0.0, 0.8}, Corner{0.3, 0.0}, Corner{0.9, -0.5},
                                         Corner{1.8, 1.2}));

TEST(Bending, WithoutTwistIsTheIsotropicOne) {
  const Base base = make_base(1.1, 0.0);
  const Vec3 e = base.e(base.at);
  const Vec3 f = base.f(base.at);
  const StencilLocal full = bending({2.0, 1.05, {0.0, 0.0}}, e, f, base.on_e(base.at), base.on_f(base.at));
  const IsotropicBendingLocal isotropic = isotropic_bending(2.0, 1.05, e, f);
  EXPECT_NEAR(full.energy, isotropic.energy, 1e-14);
  EXPECT_LT((full.gradient.segment<3>(0) + isotropic.gradient_e).norm(), 1e-13);
  EXPECT_LT((full.gradient.segment<3>(8) - isotropic.gradient_f).norm(), 1e-13);
  EXPECT_NEAR(full.gradient[3], 0.0, 1e-14);
}

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
