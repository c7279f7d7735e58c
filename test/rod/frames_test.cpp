#include "knot_utm/rod/frames.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "knot_utm/rod/rod.hpp"
#include "knot_utm/rod/turning_angle.hpp"
#include "knot_utm/rod/twisting.hpp"
#include "rod/materials.hpp"

namespace knot_utm {
namespace {

constexpr double kRounding = 1e-12;

/// Closed trefoil of n edges; the first node is repeated at the end, and the second after it.
Points trefoil(Eigen::Index n) {
  Points x(3, n + 2);
  for (Eigen::Index i = 0; i < n + 2; ++i) {
    const double s = 2.0 * M_PI * static_cast<double>(i % n) / static_cast<double>(n);
    x.col(i) = Vec3(std::sin(s) + 2.0 * std::sin(2.0 * s), std::cos(s) - 2.0 * std::cos(2.0 * s), -std::sin(3.0 * s));
  }
  return x;
}

/// Writhe of the closed polygon x_0 ... x_{n-1}: the exact double sum over pairs of edges.
double writhe(const Points& x, Eigen::Index n) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      const Vec3 a = x.col(i), b = x.col(i + 1), c = x.col(j), d = x.col(j + 1);
      const Vec3 n1 = (c - a).cross(d - a).normalized();
      const Vec3 n2 = (d - a).cross(d - b).normalized();
      const Vec3 n3 = (d - b).cross(c - b).normalized();
      const Vec3 n4 = (c - b).cross(c - a).normalized();
      const double area = std::asin(n1.dot(n2)) + std::asin(n2.dot(n3)) + std::asin(n3.dot(n4)) + std::asin(n4.dot(n1));
      sum += std::copysign(area, (d - c).cross(b - a).dot(c - a));
    }
  }
  return sum / (2.0 * M_PI);
}

TEST(Frames, TransportRotatesTangentToTangentAndKeepsTheirNormal) {
  const Vec3 from = Vec3(1.0, 2.0, 3.0).normalized();
  const Vec3 to = Vec3(-2.0, 1.0, 0.4).normalized();
  const Vec3 normal = from.cross(to).normalized();
  EXPECT_LT((parallel_transport(from, from, to) - to).norm(), kRounding);
  EXPECT_LT((parallel_transport(normal, from, to) - normal).norm(), kRounding);
  EXPECT_LT((parallel_transport(from.cross(normal), from, to) - to.cross(normal)).norm(), kRounding);
  const Vec3 same = parallel_transport(normal, from, from);
  EXPECT_LT((same - normal).norm(), kRounding);
}

TEST(Frames, TransportToTheOppositeTangentKeepsAFrame) {
  const Vec3 from = Vec3(1.0, 2.0, 3.0).normalized();
  const Vec3 d = any_normal(from);
  const Vec3 moved = parallel_transport(from.cross(d), from, -from);
  EXPECT_NEAR(moved.norm(), 1.0, kRounding);
  EXPECT_NEAR(moved.dot(from), 0.0, kRounding);
  EXPECT_LT((parallel_transport(from, from, -from) + from).norm(), kRounding);
}

TEST(Frames, HolonomyOfATrefoilIsItsWrithe) {
  for (const Eigen::Index n : {24, 61, 120}) {
    const Points x = trefoil(n);
    const Points t = tangents(x);
    const Points d1 = space_parallel_directors(x, Vec3::UnitZ());
    const Vec3 start = d1.col(0);
    const Vec3 end = d1.col(n);
    // A ribbon closes after a whole number of turns (Calugareanu): holonomy/2pi = writhe modulo 1.
    const double turns = signed_angle(start, end, t.col(0)) / (2.0 * M_PI);
    EXPECT_NEAR(std::remainder(turns - writhe(x, n), 1.0), 0.0, 1e-10) << "n = " << n;
    EXPECT_GT(std::abs(writhe(x, n)), 3.0);
  }
}

TEST(Frames, RightHandedTwistIsPositive) {
  const Vec3 t = Vec3::UnitZ();
  const Directors m = material_directors(t, Vec3::UnitX(), 0.3);
  EXPECT_LT((m.m1 - Vec3(std::cos(0.3), std::sin(0.3), 0.0)).norm(), kRounding);
  EXPECT_LT((m.m2 - t.cross(m.m1)).norm(), kRounding);
  EXPECT_NEAR(reference_twist(Vec3::UnitX(), t, m.m1, t), 0.3, kRounding);
}

TEST(Frames, ReferenceTwistCountsWholeTurns) {
  // A right-angled corner whose second edge circles around the first, twice.
  RodState state;
  state.position.resize(3, 3);
  state.position.col(0) = -Vec3::UnitZ();
  state.position.col(1).setZero();
  state.position.col(2) = Vec3::UnitX();
  initialise_frames(&state);
  constexpr int kSteps = 400;
  for (int step = 1; step <= kSteps; ++step) {
    const Points before = state.position;
    const double angle = 4.0 * M_PI * step / kSteps;
    state.position.col(2) = Vec3(std::cos(angle), std::sin(angle), 0.0);
    transport_frames(before, &state);
  }
  // On the second edge nothing turns about the tangent; seen from the first, its frame goes round with the corner.
  EXPECT_NEAR(std::abs(state.reference_twist[0]), 4.0 * M_PI, 1e-10);
}

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

double w_of(double angle) { return std::sin(0.5 * angle) * std::sin(0.5 * angle); }

double squared(double angle) {
  const double w = w_of(angle);
  return w * squared_angle_over(w).value;
}

TEST(SquaredAngle, IsThatOfTheAngleWhereEdgesResolveTheBend) {
  const std::pair<double, double> bounds[] = {
      {0.1, 1e-15}, {0.5, 8e-10}, {1.0, 3e-6}, {0.5 * M_PI, 5.1e-4}, {2.0, 9e-3}};
  for (const auto& [angle, relative] : bounds)
    EXPECT_NEAR(squared(angle), angle * angle, relative * angle * angle) << "at " << angle << " rad";
}

TEST(SquaredAngle, KeepsItsDigitsWhereTheRodIsNearlyStraight) {
  for (const double angle : {1e-3, 1e-7, 1e-12, 1e-100})
    EXPECT_NEAR(squared(angle) / (angle * angle), 1.0, 1e-14) << "at " << angle << " rad";
}

/// Never less than phi^2, ever steeper, and without bound: the moment k_b/lbar dg/dphi/2 that holds against folding.
TEST(SquaredAngle, HoldsAgainstFolding) {
  constexpr double kStep = 1e-3;
  double before = squared(0.0), slope_before = 0.0;
  for (double angle = kStep; angle < M_PI - 0.5 * kStep; angle += kStep) {
    const double here = squared(angle), slope = (here - before) / kStep;
    EXPECT_GE(here, angle * angle * (1.0 - 4e-15)) << "at " << angle << " rad";
    EXPECT_GT(slope, slope_before) << "at " << angle << " rad";
    before = here;
    slope_before = slope;
  }
  for (const double short_of_a_fold : {1e-2, 1e-3, 1e-4}) {
    const double pole = std::cos(0.5 * (M_PI - short_of_a_fold));  // sqrt(1 - w)
    EXPECT_NEAR(squared(M_PI - short_of_a_fold) * pole * pole, kTurningSeries.last, 0.03);
  }
}

TEST(SquaredAngle, DerivativesAreThoseOfTheValue) {
  constexpr double kStep = 1e-6;
  for (const double w : {0.0, 1e-9, 0.01, 0.2, 0.5, 0.8, 0.9}) {
    const auto here = squared_angle_over(w), ahead = squared_angle_over(w + kStep),
               behind = squared_angle_over(w - kStep);
    const double first = (ahead.value - behind.value) / (2.0 * kStep);
    const double second = (ahead.first - behind.first) / (2.0 * kStep);
    EXPECT_NEAR(here.first, first, 1e-8 * std::abs(first)) << "w = " << w;
    EXPECT_NEAR(here.second, second, 1e-8 * std::abs(second)) << "w = " << w;
  }
}

TEST(TurningAngle, IsThatBetweenTheTangents) {
  for (const double angle : {0.0, 1e-9, 0.3, 2.0, M_PI - 1e-9, M_PI})
    EXPECT_NEAR(turning_angle(Vec3::UnitX(), {std::cos(angle), 0.0, std::sin(angle)}), angle, 1e-15 * M_PI);
}

}  // namespace
}  // namespace knot_utm
