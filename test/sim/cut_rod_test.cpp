// Several ropes in one rod: what a cut edge leaves undone.

#include <gtest/gtest.h>

#include <memory>

#include "knot_utm/rod/energy.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

constexpr int kEdges = 12;  // of each rope

/// A rope of braided cord that falls from a held end, begun with an arc so that it bends, stretches and turns.
Points arc(double x) {
  Points out(3, kEdges + 1);
  const double h = braided_rope().radius, radius = 8.0 * h;
  for (int i = 0; i <= kEdges; ++i) {
    const double angle = h * i / radius;
    out.col(i) = Vec3(x + radius * (1.0 - std::cos(angle)), 0.2 * h * i, radius * std::sin(angle));
  }
  return out;
}

Eigen::VectorXd lengths(const Points& points) {
  const Eigen::Index edges = points.cols() - 1;
  return 1.01 * (points.rightCols(edges) - points.leftCols(edges)).colwise().norm().transpose();
}

/// Some ropes, joined to one rod, each held at its first node.
struct Ropes {
  RodProperties rod;
  RodState state;
  Boundary boundary;

  Ropes(const std::vector<double>& places, bool twist) {
    std::vector<int> cuts;
    state.position.resize(3, static_cast<Eigen::Index>(places.size()) * (kEdges + 1));
    for (std::size_t k = 0; k < places.size(); ++k) {
      const int first = static_cast<int>(k) * (kEdges + 1);
      if (k > 0) cuts.push_back(first - 1);
      state.position.middleCols(first, kEdges + 1) = arc(places[k]);
      boundary.fixed_nodes.push_back({first, state.position.col(first)});
    }
    rod = make_rod(braided_rope(), lengths(state.position), cuts);
    state.velocity = Points::Zero(3, state.position.cols());
    if (twist) initialise_frames(&state);
  }
};

StepSettings falling() {
  StepSettings out = closed_form_settings(braided_rope());
  out.gravity = Vec3(0.0, 0.0, -9.81);
  return out;
}

class CutRod : public ::testing::TestWithParam<bool> {};

TEST_P(CutRod, MovesAsItsRopesDoByThemselves) {
  const double apart = 100.0 * braided_rope().radius;
  Ropes both({0.0, apart}, GetParam()), first({0.0}, GetParam()), second({apart}, GetParam());
  const auto fall = [](Ropes& ropes) {
    std::unique_ptr<TimeStep> step = TimeStep::make(ropes.rod, ropes.state, falling());
    for (int i = 0; i < 40; ++i) EXPECT_TRUE(step->step(ropes.boundary, 1e-4).accepted());
    return step;
  };
  const auto joined = fall(both), one = fall(first), other = fall(second);
  const Points& x = joined->state().position;
  // The nodes moved by some millimetres; the residual moves them by less than a nanometre.
  EXPECT_GT((x.leftCols(kEdges + 1) - arc(0.0)).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_NEAR((x.leftCols(kEdges + 1) - one->state().position).cwiseAbs().maxCoeff(), 0.0, 1e-9);
  EXPECT_NEAR((x.rightCols(kEdges + 1) - other->state().position).cwiseAbs().maxCoeff(), 0.0, 1e-9);
  const Energies sum = joined->readings().energies(), of_one = one->readings().energies(),
                 of_other = other->readings().energies();
  EXPECT_NEAR(sum.stretching, of_one.stretching + of_other.stretching, 1e-6 * sum.stretching);
  EXPECT_NEAR(sum.bending, of_one.bending + of_other.bending, 1e-6 * sum.bending);
  EXPECT_NEAR(sum.kinetic, of_one.kinetic + of_other.kinetic, 1e-6 * sum.kinetic);
  EXPECT_EQ(joined->tension()[kEdges], 0.0);
}

/// As two strands that were both drawn upwards, one below the other: a turn by half a circle has no curvature.
TEST_P(CutRod, MayBeJoinedByALinkThatLiesBackAlongItsRopes) {
  const double h = braided_rope().radius;
  const auto strand = [&](double from) {
    Points x = Points::Zero(3, kEdges + 1);
    for (int i = 0; i <= kEdges; ++i) x.col(i) = Vec3(0.0, 0.0, from + h * i);
    return x;
  };
  const auto fallen = [&](const Points& x, const std::vector<int>& cuts) {
    Ropes ropes({0.0}, false);
    ropes.rod = make_rod(braided_rope(), lengths(x) / 1.01, cuts);
    ropes.state = {};
    ropes.state.position = x;
    ropes.state.velocity = Points::Zero(3, x.cols());
    if (GetParam()) initialise_frames(&ropes.state);
    ropes.boundary.fixed_nodes.clear();
    for (int first = 0; first < static_cast<int>(x.cols()); first += kEdges + 1)
      ropes.boundary.fixed_nodes.push_back({first, x.col(first)});
    StepSettings settings = falling();
    settings.gravity = Vec3(9.81, 0.0, 0.0);
    const std::unique_ptr<TimeStep> step = TimeStep::make(ropes.rod, ropes.state, settings);
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(step->step(ropes.boundary, 1e-4).accepted());
    return step->state().position;
  };
  const Points upper = strand(0.0);
  Points both(3, 2 * upper.cols());
  both << upper, strand(-3.0 * kEdges * h);
  const Points x = fallen(both, {kEdges}), one = fallen(upper, {});
  EXPECT_GT(one.row(0).maxCoeff(), 1e-6);
  EXPECT_NEAR((x.leftCols(kEdges + 1) - one).cwiseAbs().maxCoeff(), 0.0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(WithoutAndWithTwist, CutRod, ::testing::Bool());

TEST(CutRod, HasTheMassLengthAndEnergyOfItsRopes) {
  const double apart = 100.0 * braided_rope().radius;
  const Ropes both({0.0, apart}, true), one({0.0}, true);
  EXPECT_NEAR(both.rod.length(), 2.0 * one.rod.length(), 1e-12);
  EXPECT_NEAR(both.rod.mass.sum(), 2.0 * one.rod.mass.sum(), 1e-12);
  const ElasticEnergy sum = elastic_energy(both.rod, both.state), half = elastic_energy(one.rod, one.state);
  EXPECT_NEAR(sum.stretching, 2.0 * half.stretching, 1e-9 * sum.stretching);
  EXPECT_NEAR(sum.bending, 2.0 * half.bending, 1e-9 * sum.bending);
  EXPECT_EQ(sum.twisting, 0.0);
}

TEST(CutRod, IsMeasuredAlongItsRopesOneBehindTheOther) {
  const RodProperties rod = Ropes({0.0, 1.0}, false).rod;
  const Eigen::VectorXd arclength = rod.arclength();
  const double half = 0.5 * rod.length();
  EXPECT_GT(arclength[kEdges + 1], 1.5 * arclength[kEdges]);
  EXPECT_NEAR(rod.place(arclength[kEdges]), half, 1e-12);
  EXPECT_NEAR(rod.place(arclength[kEdges + 1]), half, 1e-12);
  EXPECT_NEAR(rod.place(kEdges + 1, 0.5), half + 0.5 * rod.rest_length[kEdges + 1], 1e-12);
  EXPECT_NEAR(rod.place(rod.edges() - 1, 1.0), rod.length(), 1e-12);
}

TEST(CutRod, ItsRopesPressOnEachOtherAndItsCutEdgeOnNothing) {
  // The second rope lies across the first one, a tenth of a radius too near; the cut edge runs through both.
  const double h = braided_rope().radius;
  Points x(3, 2 * (kEdges + 1));
  for (int i = 0; i <= kEdges; ++i) {
    x.col(i) = Vec3(h * (i - 0.5 * kEdges), 0.0, 0.0);
    x.col(kEdges + 1 + i) = Vec3(0.0, h * (i - 0.5 * kEdges), 1.9 * h);
  }
  RodState state;
  state.position = x;
  state.velocity = Points::Zero(3, x.cols());
  Eigen::VectorXd rest = Eigen::VectorXd::Constant(x.cols() - 1, h);
  const RodProperties rod = make_rod(braided_rope(), rest, {kEdges});
  const std::unique_ptr<TimeStep> step = TimeStep::make(rod, state, closed_form_settings(braided_rope()));
  ASSERT_TRUE(step->step({}, 1e-5).accepted());
  EXPECT_GT(step->readings().contact().normal_force, 0.0);
  const Vec3 up = step->state().position.rightCols(kEdges + 1).rowwise().mean(),
             down = step->state().position.leftCols(kEdges + 1).rowwise().mean();
  EXPECT_GT(up[2], 1.9 * h);
  EXPECT_NEAR(up[2] - 1.9 * h, -down[2], 1e-9);
}

}  // namespace
}  // namespace knot_utm
