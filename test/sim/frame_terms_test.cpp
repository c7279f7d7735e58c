#include "knot_utm/sim/frame_terms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <tuple>
#include <utility>

#include "knot_utm/rod/energy.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/stretching.hpp"
#include "knot_utm/sim/centreline_terms.hpp"
#include "knot_utm/specimen/material.hpp"
#include "rod/finite_difference.hpp"
#include "rod/isotropic_bending_local.hpp"
#include "rod/own_laws.hpp"
#include "sim/scenes.hpp"

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
    std::mt19937 random(8);  // no node is so near to its yield that finite differences straddle it
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
    terms.begin(step, false);
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
    const Boundary free;
    const StepStart step{start, free, 1.0};
    LinearSystem<4> system{step, start.position, matrix, right, {}, nullptr};
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
    terms.write(std::vector<double>(nodes - 1), committed);
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
  terms.write(std::vector<double>(nodes - 1), at_trial);
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

constexpr int kNodes = 9;

/// A crumpled rod whose edges are of unequal length and strain, and what stretching.hpp and isotropic_bending.hpp say
/// of it term by term: the oracle.
struct Crumpled {
  RodProperties rod;
  Points position{3, kNodes};
  RodState state;  // at that position
  Boundary free;
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(3, kNodes);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(3 * kNodes, 3 * kNodes);

  explicit Crumpled(bool bends, const StretchingLaws& law = LinearStretching()) {
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
    set_law(rod, law);
    for (int j = 0; j + 1 < kNodes; ++j) {
      const StretchingLocal local = std::visit(
          [&](const auto& own) { return stretching(own, material.stretching_stiffness, rest[j], edge(j)); }, law);
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
    state.position = position;
  }

  StepStart step() const { return {state, free, 1.0}; }

  Vec3 edge(int j) const { return position.col(j + 1) - position.col(j); }

  /// dE/de_j and d2E/(de_j de_k), on the nodes at both ends of both edges.
  void add(int j, int k, const Mat3& hessian, const Vec3& on_j) {
    force.col(j) += on_j;
    force.col(j + 1) -= on_j;
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) stiffness.block<3, 3>(3 * (j + a), 3 * (k + b)) += (a == b ? 1.0 : -1.0) * hessian;
  }
};

using Case = std::tuple<bool, StretchingLaws>;
class CentrelineTermsOf : public testing::TestWithParam<Case> {
 protected:
  bool bends_ = std::get<0>(GetParam());
  StretchingLaws law_ = std::get<1>(GetParam());
};

TEST_P(CentrelineTermsOf, ForcesAreThoseOfEveryTerm) {
  const Crumpled scene(bends_, law_);
  CentrelineTerms terms(scene.rod, bends_);
  std::vector<Lanes> force(kNodes, Lanes{0.0, 0.0, 0.0, 0.0});
  terms.add_forces(scene.step(), scene.position, force);
  Eigen::MatrixXd ours(3, kNodes);
  for (int i = 0; i < kNodes; ++i)
    for (int j = 0; j < 3; ++j) ours(j, i) = force[static_cast<std::size_t>(i)][j];
  EXPECT_LT((ours - scene.force).norm(), 1e-13 * kNodes * scene.force.norm());  // rounding
  double largest = 0.0;
  for (int j = 0; j + 1 < kNodes; ++j)
    largest = std::max(largest, std::abs(respond(scene.rod, j, stretched_edge(scene.rod, scene.position, j)).tension));
  EXPECT_NEAR(terms.largest_tension(), largest, 1e-13 * scene.rod.material.stretching_stiffness);
}

template <int D>
void add_stiffness(const CentrelineTerms& terms, const Crumpled& scene, StepMatrix<D>& matrix) {
  std::vector<Lanes> right(kNodes);
  const StepStart step = scene.step();
  LinearSystem<D> system{step, scene.position, matrix, right, {}, nullptr};
  terms.add_stiffness(system);
}

template <int D>
void expect_stiffness_of_every_term(bool bends, const StretchingLaws& law) {
  const Crumpled scene(bends, law);
  CentrelineTerms terms(scene.rod, bends);
  std::vector<Lanes> force(kNodes);
  terms.add_forces(scene.step(), scene.position, force);
  StepMatrix<D> matrix(kNodes);
  matrix.locate({});
  const Eigen::MatrixXd& expected = scene.stiffness;

  add_stiffness(terms, scene, matrix);
  add_stiffness(terms, scene, matrix);  // replaces what stood there
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
  expect_stiffness_of_every_term<3>(bends_, law_);
  expect_stiffness_of_every_term<4>(bends_, law_);
}

/// The energy, and how it changes with an increment: by differences of rod/energy.hpp.
TEST_P(CentrelineTermsOf, EnergyIsThatOfEveryTermAndItsSlopeThatOfTheForces) {
  const Crumpled scene(bends_, law_);
  CentrelineTerms terms(scene.rod, bends_);
  std::vector<Lanes> force(kNodes, Lanes{0.0, 0.0, 0.0, 0.0});
  terms.add_forces(scene.step(), scene.position, force);
  const Points increment = 0.1 * scene.rod.material.radius * Points::Random(3, kNodes);
  const CentrelineTerms::Energy energy = terms.energy(increment);
  const ElasticEnergy expected = elastic_energy(scene.rod, scene.state);
  EXPECT_NEAR(energy.stretching, expected.stretching, 1e-13 * expected.stretching);
  EXPECT_NEAR(energy.bending, bends_ ? expected.bending : 0.0, 1e-13 * expected.bending);
  const double along = -(scene.force.array() * increment.array()).sum();
  EXPECT_NEAR(energy.along, along, 1e-13 * kNodes * scene.force.norm() * increment.norm());
}

INSTANTIATE_TEST_SUITE_P(Rods, CentrelineTermsOf,
                         testing::Combine(testing::Bool(), testing::Values(StretchingLaws(LinearStretching()),
                                                                           StretchingLaws(NeoHookeanStretching()))),
                         [](const testing::TestParamInfo<Case>& of) {
                           return std::string(StretchingRegistry::kNames[std::get<1>(of.param).index()]) +
                                  (std::get<0>(of.param) ? "_bending" : "_stretchingOnly");
                         });

class PredictedTension : public testing::TestWithParam<StretchingLaws> {};

/// Two edges that a change turns: the predicted tensions follow its linear model, not their new lengths.
TEST_P(PredictedTension, IsThatOfTheLinearModelOfAChange) {
  const Crumpled scene(false, GetParam());
  CentrelineTerms terms(scene.rod, false);
  std::vector<Lanes> force(kNodes);
  terms.begin(scene.step(), true);
  terms.add_forces(scene.step(), scene.position, force);
  std::vector<Lanes> change(kNodes);
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 0.1 * scene.rod.material.radius);
  for (Lanes& each : change) each = Lanes{noise(random), noise(random), noise(random), 0.0};
  constexpr double kFactor = 0.7;
  terms.predict(change, kFactor);
  std::vector<Lanes> moved_force(kNodes);
  Points moved = scene.position;
  for (int i = 0; i < kNodes; ++i) moved.col(i) += kFactor * to_vec3(change[static_cast<std::size_t>(i)]);
  terms.add_forces(scene.step(), moved, moved_force);
  StepMatrix<3> matrix(kNodes);
  matrix.locate({});
  add_stiffness(terms, scene, matrix);

  const double k_s = scene.rod.material.stretching_stiffness;
  for (int j = 0; j + 1 < kNodes; ++j) {
    const double l0 = scene.rod.rest_length[j];
    const Vec3 before = scene.edge(j), after = moved.col(j + 1) - moved.col(j);
    const StretchingResponse response = respond(scene.rod, j, stretched_edge(scene.rod, scene.position, j));
    const double tension = response.tension + response.slope / l0 * before.normalized().dot(after - before);
    const double slope = respond(scene.rod, j, stretched_edge(scene.rod, moved, j)).slope;
    const Vec3 t = after.normalized();
    const Mat3 expected =
        slope / l0 * t * t.transpose() + tension / after.norm() * (Mat3::Identity() - t * t.transpose());
    const Block<3>& block = matrix.block(matrix.values().pattern().index(j, j + 1));
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(block(r, c), -expected(r, c), 1e-12 * k_s / l0) << "edge " << j;
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, PredictedTension,
                         testing::Values(StretchingLaws(LinearStretching()), StretchingLaws(NeoHookeanStretching())));

/// Iterations that one long step takes in which a taut string is plucked, its stretching stiffness so many times a
/// rope's.
int iterations_of_a_pluck(double times, SolveStrategy strategy) {
  constexpr int kEdges = 20;
  constexpr double kTension = 10.0, kPluck = 2.0;  // [N]
  Material material = braided_rope();
  material.stretching_stiffness *= times;
  const RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(kEdges, material.radius));
  StepSettings settings = closed_form_settings(material);
  settings.residual = 1e-4;
  settings.residual_of_tension = 0.0;
  settings.newton_cap = settings.motion_limit = rod.length();
  RodState state = straight_state(rod);
  state.position *= 1.0 + kTension / material.stretching_stiffness;
  const std::unique_ptr<TimeStep> stepper = TimeStep::make(rod, state, settings);
  Boundary boundary;
  boundary.fixed_nodes = {{0, state.position.col(0)}};
  boundary.forces = {{kEdges, Vec3(kTension, 0.0, 0.0)}, {kEdges / 2, Vec3(0.0, kPluck, 0.0)}};
  const StepSummary summary = stepper->step(boundary, 10.0, strategy);
  EXPECT_TRUE(summary.accepted()) << summary.reason;
  return summary.newton.iterations;
}

TEST(CentrelineTerms, AtExpectedTensionsIterationsDoNotGrowWithTheStretchingStiffness) {
  const int rope = iterations_of_a_pluck(1.0, SolveStrategy::kTangentsAbandonedEarly);
  EXPECT_LE(iterations_of_a_pluck(1e3, SolveStrategy::kTangentsAbandonedEarly), rope + 1);
  EXPECT_LT(rope, iterations_of_a_pluck(1.0, SolveStrategy::kTangents)) << "at present tensions";
}

}  // namespace
}  // namespace knot_utm
