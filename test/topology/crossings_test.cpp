#include "knot_utm/topology/crossings.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

#include "knot_utm/topology/knot_hole.hpp"

namespace knot_utm {
namespace {

using Found = std::vector<std::tuple<Eigen::Index, Eigen::Index, bool, bool>>;  // over, under, positive, first over

Found sorted(const std::vector<Crossing>& crossings) {
  Found found;
  for (const Crossing& c : crossings) found.emplace_back(c.over, c.under, c.positive, c.first_over);
  std::sort(found.begin(), found.end());
  return found;
}

/// Adds what segment i of one polygon and segment j of another make when seen along z.
void add_crossing(const Points& first, Eigen::Index i, const Points& second, Eigen::Index j, Found& found) {
  const Vec3 a = first.col(i), u = first.col((i + 1) % first.cols()) - a;
  const Vec3 c = second.col(j), v = second.col((j + 1) % second.cols()) - c;
  Eigen::Matrix2d directions;
  directions << u.head<2>(), -v.head<2>();
  const Eigen::Vector2d at = directions.inverse() * (c - a).head<2>();
  if (at.minCoeff() < 0.0 || at.maxCoeff() > 1.0) return;
  const bool first_over = a.z() + at[0] * u.z() > c.z() + at[1] * v.z();
  const Vec3 upper = first_over ? u : v, lower = first_over ? v : u;
  const bool positive = upper.cross(lower).z() > 0.0;
  found.emplace_back(first_over ? i : j, first_over ? j : i, positive, first_over);
}

/// A walk in space, closed by one long segment.
Points random_polygon(Eigen::Index points, std::mt19937& random) {
  std::normal_distribution<double> normal;
  Points polygon(3, points);
  Vec3 at = Vec3::Zero();
  for (Eigen::Index i = 0; i < points; ++i) polygon.col(i) = at += Vec3(normal(random), normal(random), normal(random));
  return polygon;
}

Mat3 random_rotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
      .normalized()
      .toRotationMatrix();
}

TEST(Crossings, OfAPolygonAreThoseOfAllPairsOfItsSegments) {
  std::mt19937 random(11);
  for (const Eigen::Index points : {3, 4, 5, 16, 33, 100, 257}) {
    const Points polygon = random_polygon(points, random);
    const Mat3 rotation = random_rotation(random);
    const Points seen = rotation * polygon;
    Found expected;
    for (Eigen::Index i = 0; i < points; ++i)
      for (Eigen::Index j = i + 2; j < (i == 0 ? points - 1 : points); ++j) add_crossing(seen, i, seen, j, expected);
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(sorted(crossings_of(polygon, rotation)), expected);
  }
}

TEST(Crossings, BetweenTwoPolygonsAreThoseOfAllPairsOfTheirSegments) {
  std::mt19937 random(12);
  for (const auto& [few, many] : {std::make_pair(3, 3), std::make_pair(3, 200), std::make_pair(90, 41)}) {
    const Points first = random_polygon(few, random), second = random_polygon(many, random);
    const Mat3 rotation = random_rotation(random);
    const Points a = rotation * first, b = rotation * second;
    Found expected;
    for (Eigen::Index i = 0; i < few; ++i)
      for (Eigen::Index j = 0; j < many; ++j) add_crossing(a, i, b, j, expected);
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(sorted(crossings_between(first, second, rotation)), expected);
    EXPECT_EQ(crossings_between(second, first, rotation).size(), expected.size());
  }
}

constexpr int kNodes = 400;
constexpr double kRadius = 0.02;

/// An open rod once around two rollers that are `distance` apart, turned by `turn` along itself [m].
Points loop(double distance, double turn) {
  const double around = M_PI * kRadius, whole = 2.0 * (distance + around);
  Points out(3, kNodes);
  for (int i = 0; i < kNodes; ++i) {
    double s = 0.99 * whole * i / (kNodes - 1) + 0.5 * distance + turn;  // from the foot of the near side, upwards
    s = std::fmod(s + whole, whole);
    if (s < distance) {
      out.col(i) = Vec3(kRadius, 0.0, s);
    } else if (s < distance + around) {
      const double angle = (s - distance) / kRadius;
      out.col(i) = Vec3(kRadius * std::cos(angle), 0.0, distance + kRadius * std::sin(angle));
    } else if (s < 2.0 * distance + around) {
      out.col(i) = Vec3(-kRadius, 0.0, 2.0 * distance + around - s);
    } else {
      const double angle = (s - 2.0 * distance - around) / kRadius;
      out.col(i) = Vec3(-kRadius * std::cos(angle), 0.0, -kRadius * std::sin(angle));
    }
  }
  return out;
}

TEST(LoopTurn, IsTheWayOfTheLoopAlongItself) {
  LoopTurn turned;
  turned.add(loop(0.25, 0.0));
  EXPECT_EQ(turned.largest(), 0.0);
  turned.add(loop(0.25, 0.03));
  EXPECT_NEAR(turned.largest(), 0.03, 2e-3);
  turned.add(loop(0.25, -0.01));
  EXPECT_NEAR(turned.largest(), 0.03, 2e-3);
}

TEST(LoopTurn, IsNotTheWayOfTheRollers) {
  LoopTurn turned;
  turned.add(loop(0.25, 0.0));
  turned.add(loop(0.32, 0.0));
  EXPECT_LT(turned.largest(), 3e-3);
}

}  // namespace
}  // namespace knot_utm
