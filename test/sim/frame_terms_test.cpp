#include "knot_utm/sim/frame_terms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "knot_utm/rod/energy.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/sim/roller_turns.hpp"
#include "knot_utm/specimen/material.hpp"
#include "rod/finite_difference.hpp"
#include "rod/own_laws.hpp"

namespace knot_utm {
namespace {

constexpr int kNodes = 8;
constexpr double kDt = 0.3;

/// A bent and twisted rod on its way: the step begins in one shape and is tried in another, half an edge away.
class FrameTermsOf : public testing::TestWithParam<bool> {
 protected:
  RodProperties rod;
  RodState start;
  StepSettings settings;
  Eigen::VectorXd trial;  // x_0, theta_0, ... as the lanes have it; the last angle is none

  FrameTermsOf() {
    settings.drag = 0.4;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    Material material;
    material.radius = 0.3;
    material.density = 1.5;
    material.stretching_stiffness = 10.0;
    material.bending_stiffness = 1.0;
    material.twisting_stiffness = 0.7;
    Eigen::VectorXd rest(kNodes - 1);
    for (double& l : rest) l = 1.0 + 0.2 * uniform(random);
    rod = make_rod(material, rest);
    if (GetParam()) {
      start.natural_curvature.resize(2, kNodes - 2);
      for (double& kappa : start.natural_curvature.reshaped()) kappa = 0.5 * uniform(random);
      rod.natural_twist.resize(kNodes - 2);
      for (double& twist : rod.natural_twist) twist = 0.5 * uniform(random);
    }
    start.position.resize(3, kNodes);
    for (int i = 0; i < kNodes; ++i) start.position.col(i) << i, 0.5 * uniform(random), 0.5 * uniform(random);
    start.velocity = Points::Zero(3, kNodes);
    initialise_frames(&start);
    for (int j = 0; j + 1 < kNodes; ++j) {
      start.twist[j] = 3.0 * uniform(random);
      start.twist_rate[j] = uniform(random);
    }
    trial.setZero(4 * kNodes);
    for (int i = 0; i < kNodes; ++i)
      for (int k = 0; k < 4; ++k)
        trial[4 * i + k] = (k < 3            ? start.position(k, i)
                            : i + 1 < kNodes ? start.twist[i]
                                             : 0.0) +
                           (i + 1 < kNodes || k < 3 ? 0.3 * uniform(random) : 0.0);
  }

  Points positions(const Eigen::VectorXd& y) const {
    Points x(3, kNodes);
    for (int i = 0; i < kNodes; ++i) x.col(i) = y.segment<3>(4 * i);
    return x;
  }

  /// Stands at y: the angles are moved there as Newton's method moves them.
  void evaluate(FrameTerms& terms, const Eigen::VectorXd& y, std::vector<Lanes>& force) const {
    force.assign(kNodes, Lanes{0.0, 0.0, 0.0, 0.0});
    const Boundary free;
    const StepStart step{start, free, kDt};
    terms.begin(step);
    terms.add_forces(step, positions(y), force);
    std::vector<Lanes> turn(kNodes, Lanes{0.0, 0.0, 0.0, 0.0});
    for (int j = 0; j + 1 < kNodes; ++j)
      turn[static_cast<std::size_t>(j)][3] = y[4 * j + 3] - start.twist[j] - kDt * start.twist_rate[j];
    terms.move(turn, 1.0);
    force.assign(kNodes, Lanes{0.0, 0.0, 0.0, 0.0});
    terms.add_forces(step, positions(y), force);
  }

  Eigen::VectorXd force_at(FrameTerms& terms, const Eigen::VectorXd& y) const {
    std::vector<Lanes> force;
    evaluate(terms, y, force);
    Eigen::VectorXd out(4 * kNodes);
    for (int i = 0; i < 4 * kNodes; ++i) out[i] = force[static_cast<std::size_t>(i / 4)][i % 4];
    return out;
  }
};

/// By the slow formulas, node by node and edge by edge.
Eigen::MatrixXd stiffness_of(const FrameTerms& terms) {
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(4 * kNodes, 4 * kNodes);
  for (int i = 1; i + 1 < kNodes; ++i) stiffness.block<12, 12>(4 * (i - 1), 4 * (i - 1)) += terms.node_stiffness(i);
  for (int j = 0; j + 1 < kNodes; ++j) {
    const FrameTerms::EdgeStiffness edge = terms.edge_stiffness(j);
    const int a = 4 * j, b = 4 * (j + 1);
    stiffness.block<3, 3>(a, a) += edge.sweep;
    stiffness.block<3, 3>(b, b) += edge.sweep;
    stiffness.block<3, 3>(a, b) -= edge.sweep;
    stiffness.block<3, 3>(b, a) -= edge.sweep;
    stiffness(a + 3, a + 3) += edge.spin;
    stiffness.block<1, 3>(a + 3, a) += edge.spin * edge.lean.transpose();
    stiffness.block<1, 3>(a + 3, b) -= edge.spin * edge.lean.transpose();
  }
  return stiffness;
}

/// Where bends yield, too: their tangent couples the two curvatures.
TEST_P(FrameTermsOf, StiffnessIsTheForcesDerivative) {
  for (const BendingLaws& law : {BendingLaws(ElasticBending()), BendingLaws(PlasticBending{0.1, 0.2})}) {
    set_law(rod, law);
    FrameTerms terms(rod, settings);
    const Eigen::MatrixXd expected =
        -finite_difference([&](const Eigen::VectorXd& y) { return force_at(terms, y); }, trial, 1e-3);
    force_at(terms, trial);
    Eigen::MatrixXd spin = Eigen::MatrixXd::Identity(4 * kNodes, 4 * kNodes);  // d(x, s)/d(x, theta)
    for (int j = 0; j + 1 < kNodes; ++j) {
      spin.block<1, 3>(4 * j + 3, 4 * (j + 1)) += terms.lean(j).transpose();
      spin.block<1, 3>(4 * j + 3, 4 * j) -= terms.lean(j).transpose();
    }
    const double difference = relative_difference(stiffness_of(terms) * spin, expected);
    EXPECT_LT(difference, 1e-8) << law.index();
  }
}

TEST_P(FrameTermsOf, TheMatrixGetsTheStiffnessOfAllNodesAndEdges) {
  FrameTerms terms(rod, settings);
  for (const int parted : {-1, 3}) {
    if (parted >= 0) terms.part(parted);
    force_at(terms, trial);
    StepMatrix<4> matrix(kNodes);
    for (int i = 0; i < kNodes; ++i)
      for (const int block : matrix.stencil(i))
        if (block >= 0) matrix.block(block).set_zero();
    std::vector<Lanes> right(kNodes);
    RollerTurns turns;
    const Boundary free;
    const StepStart step{start, free, 1.0};
    LinearSystem<4> system{step, start.position, matrix, right, turns, {}, nullptr};
    terms.add_stiffness(system);
    const Eigen::MatrixXd slow = stiffness_of(terms);
    double largest = 0.0;
    for (int i = 0; i < kNodes; ++i)
      for (int k = 0; k < 3 && i + k < kNodes; ++k)
        for (const auto& [row, column] : {std::pair{i, i + k}, std::pair{i + k, i}}) {
          const Block<4>& block = matrix.band(i, row - i, column - i);
          for (int r = 0; r < 4; ++r)
            for (int c = 0; c < 4; ++c)
              largest = std::max(largest, std::abs(block(r, c) - slow(4 * row + r, 4 * column + c)));
        }
    EXPECT_LT(largest, 1e-13 * slow.cwiseAbs().maxCoeff()) << "parted edge " << parted;
  }
}

/// Near the step's beginning without an arctangent, far from it with one.
TEST_P(FrameTermsOf, TheReferenceTwistIsThatOfCarriedFrames) {
  FrameTerms terms(rod, settings);
  for (const double share : {1.0, 0.1, 1e-3, 1e-9, 0.0}) {
    Eigen::VectorXd y = trial;
    for (int i = 0; i < kNodes; ++i)
      y.segment<3>(4 * i) = start.position.col(i) + share * (trial.segment<3>(4 * i) - start.position.col(i));
    std::vector<Lanes> force;
    evaluate(terms, y, force);
    RodState moved = start;
    moved.position = positions(y);
    for (int j = 0; j + 1 < kNodes; ++j) moved.twist[j] = y[4 * j + 3];
    transport_frames(start.position, &moved);
    const double carried = elastic_energy(rod, moved).twisting;
    EXPECT_NEAR(terms.energy(moved.position - start.position, force).twisting, carried, 1e-13 * carried) << share;
    RodState committed = start;
    committed.position = moved.position;
    terms.commit(std::vector<double>(kNodes - 1), committed);
    EXPECT_LT((committed.reference_twist - moved.reference_twist).norm(), 1e-14);
    EXPECT_LT((committed.reference_director - moved.reference_director).norm(), 1e-14);
  }
}

TEST_P(FrameTermsOf, ForcesAreTheEnergysSlopeAtFixedSpin) {
  settings.spin_inertia = false;
  FrameTerms terms(rod, settings);
  const Eigen::VectorXd force = force_at(terms, trial);
  RodState at_trial = start;
  at_trial.position = positions(trial);
  terms.commit(std::vector<double>(kNodes - 1), at_trial);
  const auto energy = [&](const Eigen::VectorXd& y) {
    RodState moved = at_trial;
    moved.position = positions(y);
    for (int j = 0; j + 1 < kNodes; ++j) moved.twist[j] = y[4 * j + 3];
    transport_frames(at_trial.position, &moved);
    const ElasticEnergy all = elastic_energy(rod, moved);
    return all.twisting + (GetParam() ? all.bending : 0.0);
  };
  const Eigen::VectorXd expected = -finite_difference_gradient(energy, trial, 1e-3);
  EXPECT_LT(relative_difference(force, expected), 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Rods, FrameTermsOf, testing::Bool(),
                         [](const auto& rods) { return rods.param ? "CurvedAtRest" : "StraightAtRest"; });

}  // namespace
}  // namespace knot_utm
