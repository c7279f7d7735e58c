#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/rod/twisting.hpp"
#include "rod/materials.hpp"

namespace knot_utm {
namespace {

constexpr double kRounding = 1e-12;

/// A helix of edges of two lengths by turns, with frames that are not twisted.
RodState helix(const RodProperties& rod) {
  RodState state;
  state.position.resize(3, rod.nodes());
  const Eigen::VectorXd along = rod.arclength();
  for (Eigen::Index i = 0; i < rod.nodes(); ++i)
    state.position.col(i) = Vec3(0.02 * std::cos(40.0 * along[i]), 0.02 * std::sin(40.0 * along[i]), 0.6 * along[i]);
  initialise_frames(&state);
  return state;
}

RodProperties rod_of_two_lengths() {
  Eigen::VectorXd lengths(20);
  for (Eigen::Index j = 0; j < lengths.size(); ++j) lengths[j] = j % 2 == 0 ? 0.003 : 0.005;
  return make_rod(nylon(), lengths);
}

TEST(TwistRates, AreThoseOfAFrameThatTurnsEvenlyAlongTheRod) {
  const RodProperties rod = rod_of_two_lengths();
  RodState state = helix(rod);
  EXPECT_LT(twist_rates(rod, state).cwiseAbs().maxCoeff(), kRounding) << "not twisted";
  constexpr double kRate = 12.0;  // [rad/m]
  const Eigen::VectorXd along = rod.arclength();
  for (Eigen::Index j = 0; j < rod.edges(); ++j) state.twist[j] = 0.5 * kRate * (along[j] + along[j + 1]);
  const Eigen::VectorXd rates = twist_rates(rod, state);
  ASSERT_EQ(rates.size(), rod.nodes() - 2);
  EXPECT_LT((rates.array() - kRate).abs().maxCoeff(), kRounding * 1e3);
}

TEST(TwistRates, DoNotDependOnTheReferenceFrame) {
  const RodProperties rod = rod_of_two_lengths();
  RodState state = helix(rod);
  for (Eigen::Index j = 0; j < rod.edges(); ++j) state.twist[j] = 0.1 * std::sin(static_cast<double>(j));
  const Eigen::VectorXd rates = twist_rates(rod, state);
  // The reference director of one edge is turned about it, and its angle back.
  constexpr Eigen::Index kEdge = 7;
  constexpr double kTurn = 0.4;  // [rad]
  const Points along = tangents(state.position);
  state.reference_director.col(kEdge) =
      Eigen::AngleAxisd(kTurn, along.col(kEdge)) * Vec3(state.reference_director.col(kEdge));
  state.twist[kEdge] -= kTurn;
  for (const Eigen::Index node : {kEdge - 1, kEdge})
    state.reference_twist[node] = reference_twist(state.reference_director.col(node), along.col(node),
                                                  state.reference_director.col(node + 1), along.col(node + 1));
  EXPECT_LT((twist_rates(rod, state) - rates).cwiseAbs().maxCoeff(), kRounding * 1e3);
}

TEST(TwistRates, AreNoneWhereTheSceneDoesNotSolveForTwist) {
  const RodProperties rod = rod_of_two_lengths();
  RodState state;
  state.position = helix(rod).position;
  EXPECT_EQ(twist_rates(rod, state).size(), 0);
}

}  // namespace
}  // namespace knot_utm
