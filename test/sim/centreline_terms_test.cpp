#include "knot_utm/sim/centreline_terms.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "knot_utm/rod/energy.hpp"
#include "knot_utm/rod/stretching.hpp"
#include "knot_utm/sim/roller_turns.hpp"
#include "rod/isotropic_bending_local.hpp"
#include "rod/own_laws.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

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
  RollerTurns turns;
  const StepStart step = scene.step();
  LinearSystem<D> system{step, scene.position, matrix, right, turns, {}, nullptr};
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
  terms.predict_tensions(change, kFactor);
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
