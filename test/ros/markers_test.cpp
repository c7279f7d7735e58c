#include "knot_utm/ros/markers.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace knot_utm {
namespace {

Vec3 vec(const geometry_msgs::Point& p) { return {p.x, p.y, p.z}; }

/// Volume inside a closed surface of triangles that wind outwards.
double enclosed_volume(const visualization_msgs::Marker& marker) {
  double volume = 0.0;
  for (std::size_t i = 0; i + 2 < marker.points.size(); i += 3) {
    volume += vec(marker.points[i]).dot(vec(marker.points[i + 1]).cross(vec(marker.points[i + 2]))) / 6.0;
  }
  return volume;
}

Points helix(int nodes) {
  Points points(3, nodes);
  for (int i = 0; i < nodes; ++i) {
    const double a = 4.0 * 3.14159265358979 * i / (nodes - 1);
    points.col(i) << 0.05 * std::cos(a), 0.05 * std::sin(a), 0.01 * a;
  }
  return points;
}

TEST(TubeMarker, ClosedSurfaceWindsOutwards) {
  const double radius = 0.002;
  const Points points = helix(400);
  const double length = (points.rightCols(399) - points.leftCols(399)).colwise().norm().sum();
  TubeOptions options;
  options.sides = 12;
  const auto marker = tube_marker(points, Eigen::VectorXd::Zero(399), radius, options);
  // A regular polygon of 12 sides in place of the circle.
  const double area = 6.0 * std::sin(3.14159265358979 / 6.0) * radius * radius;
  EXPECT_NEAR(enclosed_volume(marker), area * length, 0.01 * area * length);
  EXPECT_EQ(marker.points.size(), 3u * 12u * 2u * 400u);
  EXPECT_EQ(marker.colors.size(), marker.points.size());
}

TEST(TubeMarker, SidesPointAwayFromTheCentreline) {
  Points points(3, 2);
  points << 0.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  const auto marker = tube_marker(points, Eigen::VectorXd::Zero(1), 0.1, TubeOptions());
  for (std::size_t i = 0; i < 3 * 2 * 10; i += 3) {
    const Vec3 a = vec(marker.points[i]), b = vec(marker.points[i + 1]), c = vec(marker.points[i + 2]);
    const Vec3 middle = (a + b + c) / 3.0;
    EXPECT_GT((b - a).cross(c - a).dot(Vec3(middle.x(), middle.y(), 0.0)), 0.0);
  }
}

TEST(TubeMarker, TensionIsRedderThanSlack) {
  Eigen::VectorXd tension(1);
  tension << 5.0;
  TubeOptions options;
  options.highest_tension = 5.0;
  const Points points = helix(2);
  const auto tight = tube_marker(points, tension, 0.01, options).colors.front();
  const auto slack = tube_marker(points, Eigen::VectorXd::Zero(1), 0.01, options).colors.front();
  EXPECT_GT(tight.r / tight.b, 3.0f * slack.r / slack.b);
}

TEST(TubeMarker, NothingToShow) { EXPECT_TRUE(tube_marker(Points(3, 0), {}, 0.01, TubeOptions()).points.empty()); }

}  // namespace
}  // namespace knot_utm
