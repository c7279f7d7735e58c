#include "knot_utm/topology/knot_hole.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <deque>
#include <random>

namespace knot_utm {
namespace {

constexpr double kRadius = 1.0;  // h of the rods here

Points drawn(const std::vector<Vec3>& places) {
  Points points(3, static_cast<Eigen::Index>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) points.col(static_cast<Eigen::Index>(i)) = places[i];
  return points;
}

/// A polygon around a circle of radius R in the plane of x and y, whose ends go on along its tangent past each other, a
/// diameter of the rod apart.
Points loop(double circle) {
  std::vector<Vec3> places;
  constexpr int kSteps = 120;
  const double corner = circle / std::cos(M_PI / kSteps);
  for (int i = 60; i > 0; --i) places.emplace_back(-0.1 * circle * i, -circle, -kRadius);
  for (int i = 0; i <= kSteps; ++i) {
    const double turn = static_cast<double>(i) / kSteps, angle = 2.0 * M_PI * turn - 0.5 * M_PI;
    places.emplace_back(corner * std::cos(angle), corner * std::sin(angle), kRadius * (2.0 * turn - 1.0));
  }
  for (int i = 1; i <= 60; ++i) places.emplace_back(0.1 * circle * i, -circle, kRadius);
  return drawn(places);
}

/// An overhand drawn on a torus: it goes twice around the axis, and three times around the core, a circle of radius
/// R; its ends go straight outwards. Seen along the axis, its inmost places are R - r away.
Points overhand_on_torus(double core, double r) {
  std::vector<Vec3> places;
  constexpr int kSteps = 1000;
  const auto at = [&](double t) {
    const double across = core + r * std::cos(3.0 * t);
    return Vec3(across * std::cos(2.0 * t), across * std::sin(2.0 * t), r * std::sin(3.0 * t));
  };
  const Vec3 first = at(0.02), last = at(2.0 * M_PI - 0.02);
  for (int i = 20; i > 0; --i) places.push_back(first + Vec3(0.1 * core * i, 0.0, 0.0));
  for (int i = 0; i <= kSteps; ++i) places.push_back(at(0.02 + (2.0 * M_PI - 0.04) * i / kSteps));
  for (int i = 1; i <= 20; ++i) places.push_back(last + Vec3(0.1 * core * i, 0.0, 0.0));
  return drawn(places);
}

Points turned(const Points& points) {
  return Eigen::AngleAxisd(1.1, Vec3(1.0, 2.0, -0.5).normalized()).toRotationMatrix() * points;
}

TEST(KnotHole, OfACircleItIsTheCircleLessTheRod) {
  constexpr double kCircle = 20.0;
  // Its ends lie a diameter apart: at most that much more could be seen from aside.
  const double exact = 2.0 * (kCircle - kRadius), aside = kRadius * kRadius / kCircle;
  const double found = hole_diameter(turned(loop(kCircle)), kRadius);
  EXPECT_GE(found, exact - 2.0 * 2e-3 * kRadius);
  EXPECT_LE(found, exact + aside);
}

TEST(KnotHole, OfARodThatFillsItsLoopItIsNone) { EXPECT_EQ(hole_diameter(loop(0.9), kRadius), 0.0); }

TEST(KnotHole, OfAStraightRodAndOfAnArchItIsNone) {
  std::vector<Vec3> straight, arch;
  for (int i = 0; i <= 100; ++i) {
    straight.emplace_back(0.0, 0.0, i);
    arch.emplace_back(20.0 * std::cos(0.01 * M_PI * i), 0.0, 20.0 * std::sin(0.01 * M_PI * i));
  }
  EXPECT_EQ(hole_diameter(drawn(straight), kRadius), 0.0);
  EXPECT_EQ(hole_diameter(drawn(arch), kRadius), 0.0);
}

TEST(KnotHole, OfAnOverhandOnATorusItIsThatAlongTheAxis) {
  constexpr double kCore = 30.0, kAround = 8.0;
  const double exact = 2.0 * (kCore - kAround - kRadius);
  const double found = hole_diameter(turned(overhand_on_torus(kCore, kAround)), kRadius);
  EXPECT_GE(found, exact - 2.0 * 2e-3 * kRadius);
  EXPECT_LE(found, 1.02 * exact);  // the axis need not be the very best view
}

/// The largest distance to the curve of all cells of a grid from which no way over cells leads out that keeps clear of
/// the curve by a cell.
double by_flooding(const Points& points, const Mat3& rotation, double cell) {
  const Eigen::Matrix2Xd flat = rotation.topRows<2>() * points;
  const Eigen::Vector2d low = flat.rowwise().minCoeff().array() - 3.0 * cell;
  const Eigen::Vector2d size = flat.rowwise().maxCoeff().array() + 3.0 * cell - low.array();
  const auto nx = static_cast<Eigen::Index>(size.x() / cell), ny = static_cast<Eigen::Index>(size.y() / cell);
  Eigen::MatrixXd distance(nx, ny);
  for (Eigen::Index x = 0; x < nx; ++x)
    for (Eigen::Index y = 0; y < ny; ++y) {
      const Eigen::Vector2d p = low + cell * Eigen::Vector2d(static_cast<double>(x), static_cast<double>(y));
      distance(x, y) = std::sqrt((flat.colwise() - p).colwise().squaredNorm().minCoeff());
    }
  Eigen::MatrixXd outside = Eigen::MatrixXd::Zero(nx, ny);
  std::deque<std::pair<Eigen::Index, Eigen::Index>> next = {{0, 0}};
  outside(0, 0) = 1.0;
  while (!next.empty()) {
    const auto [x, y] = next.front();
    next.pop_front();
    for (const auto& [i, j] : {std::pair{x + 1, y}, {x - 1, y}, {x, y + 1}, {x, y - 1}}) {
      if (i < 0 || j < 0 || i >= nx || j >= ny || outside(i, j) > 0.0 || distance(i, j) < cell) continue;
      outside(i, j) = 1.0;
      next.emplace_back(i, j);
    }
  }
  double largest = 0.0;
  for (Eigen::Index x = 0; x < nx; ++x)
    for (Eigen::Index y = 0; y < ny; ++y)
      if (outside(x, y) == 0.0) largest = std::max(largest, distance(x, y));
  return largest;
}

TEST(KnotHole, OfTangledCurvesTheCircleIsThatWhichFloodingLeaves) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int curve = 0; curve < 10; ++curve) {
    // Smooth: a few waves in each direction.
    Vec3 waves[6];
    for (Vec3& wave : waves) wave = Vec3(normal(random), normal(random), normal(random));
    std::vector<Vec3> places;
    for (int i = 0; i <= 800; ++i) {
      Vec3 at = Vec3::Zero();
      for (int k = 0; k < 6; ++k) at += waves[k] * std::cos(0.002 * (k + 1) * i + k) * 10.0 / (1.0 + 0.3 * k);
      places.push_back(at);
    }
    const Points points = drawn(places);
    constexpr double kCell = 0.15;  // the curve's points are nearer to each other than that
    const double flooded = by_flooding(points, Mat3::Identity(), kCell);
    const double found = largest_enclosed_circle(points, Mat3::Identity(), 1e-3).radius;
    // Cells nearer to the curve than one are taken for enclosed, and the best place lies between cells.
    EXPECT_NEAR(found, flooded, 1.5 * kCell) << curve;
  }
}

}  // namespace
}  // namespace knot_utm
