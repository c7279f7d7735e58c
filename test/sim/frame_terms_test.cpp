#include "knot_utm/sim/frame_terms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <tuple>
#include <utility>

#include "knot_utm/rod/energy.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/sim/roller_turns.hpp"
#include "knot_utm/specimen/material.hpp"
#include "rod/finite_difference.hpp"
#include "rod/own_laws.hpp"

namespace knot_utm {
namespace {

constexpr double kDt = 0.3;

/// A bent and twisted rod on its way: the step begins in one shape and is tried in another, half an edge away.
class FrameTermsOf : public testing::TestWithParam<std::tuple<bool, int>> {
 protected:
  const bool curved = std::get<0>(GetParam());
  const int nodes = std::get<1>(GetParam());
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
    Eigen::VectorXd rest(nodes - 1);
    for (double& l : rest) l = 1.0 + 0.2 * uniform(random);
    rod = make_rod(material, rest);
    if (curved) {
      start.natural_curvature.resize(2, nodes - 2);
      for (double& kappa : start.natural_curvature.reshaped()) kappa = 0.5 * uniform(random);
    }
    start.position.resize(3, nodes);
    for (int i = 0; i < nodes; ++i) start.position.col(i) << i, 0.5 * uniform(random), 0.5 * uniform(random);
    start.velocity = Points::Zero(3, nodes);
    initialise_frames(&start);
    for (int j = 0; j + 1 < nodes; ++j) {
      start.twist[j] = 3.0 * uniform(random);
      start.twist_rate[j] = uniform(random);
    }
    trial.setZero(4 * nodes);
    for (int i = 0; i < nodes; ++i)
      for (int k = 0; k < 4; ++k)
        trial[4 * i + k] = (k < 3           ? start.position(k, i)
                            : i + 1 < nodes ? start.twist[i]
                                            : 0.0) +
                           (i + 1 < nodes || k < 3 ? 0.3 * uniform(random) : 0.0);
  }

  Points positions(const Eigen::VectorXd& y) const {
    Points x(3, nodes);
    for (int i = 0; i < nodes; ++i) x.col(i) = y.segment<3>(4 * i);
    return x;
  }

  /// Stands at y: the angles are moved there as Newton's method moves them.
  void evaluate(FrameTerms& terms, const Eigen::VectorXd& y, std::vector<Lanes>& force) const {
    force.assign(nodes, Lanes{0.0, 0.0, 0.0, 0.0});
    const Boundary free;
    const StepStart step{start, free, kDt};
    terms.begin(step);
    terms.add_forces(step, positions(y), force);
    std::vector<Lanes> turn(nodes, Lanes{0.0, 0.0, 0.0, 0.0});
    for (int j = 0; j + 1 < nodes; ++j)
      turn[static_cast<std::size_t>(j)][3] = y[4 * j + 3] - start.twist[j] - kDt * start.twist_rate[j];
    terms.move(turn, 1.0);
    force.assign(nodes, Lanes{0.0, 0.0, 0.0, 0.0});
    terms.add_forces(step, positions(y), force);
  }

  Eigen::VectorXd force_at(FrameTerms& terms, const Eigen::VectorXd& y) const {
    std::vector<Lanes> force;
    evaluate(terms, y, force);
    Eigen::VectorXd out(4 * nodes);
    for (int i = 0; i < 4 * nodes; ++i) out[i] = force[static_cast<std::size_t>(i / 4)][i % 4];
    return out;
  }
};

/// By the slow formulas, node by node and edge by edge.
Eigen::MatrixXd stiffness_of(const FrameTerms& terms, int nodes) {
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(4 * nodes, 4 * nodes);
  for (int i = 1; i + 1 < nodes; ++i) stiffness.block<12, 12>(4 * (i - 1), 4 * (i - 1)) += terms.node_stiffness(i);
  for (int j = 0; j + 1 < nodes; ++j) {
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
    Eigen::MatrixXd spin = Eigen::MatrixXd::Identity(4 * nodes, 4 * nodes);  // d(x, s)/d(x, theta)
    for (int j = 0; j + 1 < nodes; ++j) {
      spin.block<1, 3>(4 * j + 3, 4 * (j + 1)) += terms.lean(j).transpose();
      spin.block<1, 3>(4 * j + 3, 4 * j) -= terms.lean(j).transpose();
    }
    const double difference = relative_difference(stiffness_of(terms, nodes) * spin, expected);
    EXPECT_LT(difference, 1e-8) << law.index();
  }
}

/// Four nodes are computed at a time, and their number need not be a multiple of that.
TEST_P(FrameTermsOf, TheMatrixGetsTheStiffnessOfAllNodesAndEdges) {
  FrameTerms terms(rod, settings);
  Eigen::VectorXd straight = trial;
  for (int i = 0; i < nodes; ++i) straight.segment<3>(4 * i) << i, 0.0, 0.0;
  const int middle = (nodes - 1) / 2;
  for (const auto& [parted, position] : {std::pair{-1, trial}, {-1, straight}, {middle, trial}, {middle, straight}}) {
    if (parted >= 0) terms.part(parted);
    force_at(terms, position);
    StepMatrix<4> matrix(nodes);
    for (int i = 0; i < nodes; ++i)
      for (const int block : matrix.stencil(i))
        if (block >= 0) matrix.block(block).set_zero();
    std::vector<Lanes> right(nodes);
    RollerTurns turns;
    const Boundary free;
    const StepStart step{start, free, 1.0};
    LinearSystem<4> system{step, start.position, matrix, right, turns, {}, nullptr};
    terms.add_stiffness(system);
    const Eigen::MatrixXd slow = stiffness_of(terms, nodes);
    double largest = 0.0;
    for (int i = 0; i < nodes; ++i)
      for (int k = 0; k < 3 && i + k < nodes; ++k)
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
    for (int i = 0; i < nodes; ++i)
      y.segment<3>(4 * i) = start.position.col(i) + share * (trial.segment<3>(4 * i) - start.position.col(i));
    std::vector<Lanes> force;
    evaluate(terms, y, force);
    RodState moved = start;
    moved.position = positions(y);
    for (int j = 0; j + 1 < nodes; ++j) moved.twist[j] = y[4 * j + 3];
    transport_frames(start.position, &moved);
    const double carried = elastic_energy(rod, moved).twisting;
    EXPECT_NEAR(terms.energy(moved.position - start.position, force).twisting, carried, 1e-13 * carried) << share;
    RodState committed = start;
    committed.position = moved.position;
    terms.commit(std::vector<double>(nodes - 1), committed);
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
  terms.commit(std::vector<double>(nodes - 1), at_trial);
  const auto energy = [&](const Eigen::VectorXd& y) {
    RodState moved = at_trial;
    moved.position = positions(y);
    for (int j = 0; j + 1 < nodes; ++j) moved.twist[j] = y[4 * j + 3];
    transport_frames(at_trial.position, &moved);
    const ElasticEnergy all = elastic_energy(rod, moved);
    return all.twisting + (curved ? all.bending : 0.0);
  };
  const Eigen::VectorXd expected = -finite_difference_gradient(energy, trial, 1e-3);
  EXPECT_LT(relative_difference(force, expected), 1e-8);
}

/// Angles of many turns give the same directors as what is left of them, and so the same forces.
TEST_P(FrameTermsOf, WholeTurnsChangeNothing) {
  FrameTerms terms(rod, settings);
  const Eigen::VectorXd force = force_at(terms, trial);
  Eigen::VectorXd turned = trial;
  for (int j = 0; j + 1 < nodes; ++j) {
    start.twist[j] += 20.0 * M_PI;
    turned[4 * j + 3] += 20.0 * M_PI;
  }
  EXPECT_LT(relative_difference(force_at(terms, turned), force), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Rods, FrameTermsOf, testing::Combine(testing::Bool(), testing::Values(3, 5, 6, 7, 8)),
                         [](const auto& rods) {
                           return (std::get<0>(rods.param) ? "CurvedAtRest" : "StraightAtRest") +
                                  std::to_string(std::get<1>(rods.param));
                         });

}  // namespace
}  // namespace knot_utm
