#include "knot_utm/sim/centreline_terms.hpp"

#include <gtest/gtest.h>

#include <random>

#include "knot_utm/rod/isotropic_bending.hpp"
#include "knot_utm/rod/stretching.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

constexpr int kNodes = 9;

/// A crumpled rod whose edges are of unequal length and strain, and what stretching.hpp and isotropic_bending.hpp say
/// of it term by term: the oracle.
struct Crumpled {
  RodProperties rod;
  Points position{3, kNodes};
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(3, kNodes);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(3 * kNodes, 3 * kNodes);

  explicit Crumpled(bool bends) {
    std::mt19937 random(11);
    std::normal_distribution<double> noise(0.0, 1.0);
    const Material material = braided_rope();
    Eigen::VectorXd rest(kNodes - 1);
    position.col(0).setZero();
    for (int j = 0; j + 1 < kNodes; ++j) {
      rest[j] = (1.0 + 0.2 * std::tanh(noise(random))) * material.radius;
      const Vec3 direction = Vec3(noise(random), noise(random), 2.0 + noise(random)).normalized();
      position.col(j + 1) = position.col(j) + (1.0 + 0.05 * std::tanh(noise(random))) * rest[j] * direction;
    }
    rod = make_rod(material, rest);
    for (int j = 0; j + 1 < kNodes; ++j) {
      const StretchingLocal local = stretching(material.stretching_stiffness, rest[j], edge(j));
      add(j, j, local.hessian, local.gradient);
    }
    for (int i = 1; bends && i + 1 < kNodes; ++i) {
      const IsotropicBendingLocal local =
          isotropic_bending(material.bending_stiffness, rod.voronoi_length[i], edge(i - 1), edge(i));
      add(i - 1, i - 1, local.hessian_ee, local.gradient_e);
      add(i, i, local.hessian_ff, local.gradient_f);
      add(i - 1, i, local.hessian_ef, Vec3::Zero());
      add(i, i - 1, local.hessian_ef.transpose(), Vec3::Zero());
    }
  }

  Vec3 edge(int j) const { return position.col(j + 1) - position.col(j); }

  /// dE/de_j and d2E/(de_j de_k), on the nodes at both ends of both edges.
  void add(int j, int k, const Mat3& hessian, const Vec3& on_j) {
    force.col(j) += on_j;
    force.col(j + 1) -= on_j;
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) stiffness.block<3, 3>(3 * (j + a), 3 * (k + b)) += (a == b ? 1.0 : -1.0) * hessian;
  }
};

class CentrelineTermsOf : public testing::TestWithParam<bool> {};

TEST_P(CentrelineTermsOf, ForcesAreThoseOfEveryTerm) {
  const Crumpled scene(GetParam());
  CentrelineTerms terms(scene.rod, GetParam());
  std::vector<Lanes> force(kNodes, Lanes{0.0, 0.0, 0.0, 0.0});
  terms.add_forces(scene.position, force);
  Eigen::MatrixXd ours(3, kNodes);
  for (int i = 0; i < kNodes; ++i)
    for (int j = 0; j < 3; ++j) ours(j, i) = force[static_cast<std::size_t>(i)][j];
  EXPECT_LT((ours - scene.force).norm(), 1e-13 * kNodes * scene.force.norm());  // rounding
  double largest = 0.0;
  for (int j = 0; j + 1 < kNodes; ++j)
    largest = std::max(largest, std::abs(stretching_tension(scene.rod.material.stretching_stiffness,
                                                            scene.rod.rest_length[j], scene.edge(j))));
  EXPECT_NEAR(terms.largest_tension(), largest, 1e-13 * scene.rod.material.stretching_stiffness);
}

template <int D>
void expect_stiffness_of_every_term(bool bends) {
  const Crumpled scene(bends);
  CentrelineTerms terms(scene.rod, bends);
  std::vector<Lanes> force(kNodes);
  terms.add_forces(scene.position, force);
  StepMatrix<D> matrix(kNodes);
  matrix.locate({});
  std::vector<double> diagonal;
  for (int i = 0; i < kNodes; ++i) diagonal.push_back(1e3 * (i + 1));
  Eigen::MatrixXd expected = scene.stiffness;
  for (int i = 0; i < 3 * kNodes; ++i) expected(i, i) += diagonal[static_cast<std::size_t>(i / 3)];

  terms.set_stiffness(diagonal, matrix);
  terms.set_stiffness(diagonal, matrix);  // replaces what stood there
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(D, D);
  for (int i = 0; i < kNodes; ++i)
    for (int j = std::max(i - 2, 0); j < std::min(i + 3, kNodes); ++j) {
      const Block<D>& block = matrix.block(matrix.values().pattern().index(i, j));
      Eigen::MatrixXd ours(D, D), theirs = zero;
      for (int r = 0; r < D; ++r)
        for (int c = 0; c < D; ++c) ours(r, c) = block(r, c);
      theirs.topLeftCorner<3, 3>() = expected.block<3, 3>(3 * i, 3 * j);
      EXPECT_LT((ours - theirs).norm(), 1e-13 * kNodes * expected.norm()) << "block " << i << ", " << j;
    }
}

TEST_P(CentrelineTermsOf, StiffnessIsThatOfEveryTerm) {
  expect_stiffness_of_every_term<3>(GetParam());
  expect_stiffness_of_every_term<4>(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Rods, CentrelineTermsOf, testing::Bool(),
                         [](const auto& bends) { return bends.param ? "bending" : "stretchingOnly"; });

}  // namespace
}  // namespace knot_utm
