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
  const auto marker = tube_marker(points, Eigen::VectorXd::Zero(400), radius, options);
  // A regular polygon of 12 sides in place of the circle.
  const double area = 6.0 * std::sin(3.14159265358979 / 6.0) * radius * radius;
  EXPECT_NEAR(enclosed_volume(marker), area * length, 0.01 * area * length);
  EXPECT_EQ(marker.points.size(), 3u * 12u * 2u * 400u);
  EXPECT_EQ(marker.colors.size(), marker.points.size());
}

TEST(TubeMarker, SidesPointAwayFromTheCentreline) {
  Points points(3, 2);
  points << 0.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  const auto marker = tube_marker(points, Eigen::VectorXd::Zero(2), 0.1, TubeOptions());
  const auto triangles = static_cast<std::size_t>(2 * TubeOptions().sides);
  for (std::size_t i = 0; i < 3 * triangles; i += 3) {
    const Vec3 a = vec(marker.points[i]), b = vec(marker.points[i + 1]), c = vec(marker.points[i + 2]);
    const Vec3 middle = (a + b + c) / 3.0;
    EXPECT_GT((b - a).cross(c - a).dot(Vec3(middle.x(), middle.y(), 0.0)), 0.0);
  }
}

TEST(TubeMarker, TensionIsRedderThanSlack) {
  TubeOptions options;
  options.highest = 5.0;
  const Points points = helix(2);
  const auto tight = tube_marker(points, Eigen::VectorXd::Constant(2, 5.0), 0.01, options).colors.front();
  const auto slack = tube_marker(points, Eigen::VectorXd::Zero(2), 0.01, options).colors.front();
  EXPECT_GT(tight.r / tight.b, 3.0f * slack.r / slack.b);
}

TEST(TubeMarker, NothingToShow) { EXPECT_TRUE(tube_marker(Points(3, 0), {}, 0.01, TubeOptions()).points.empty()); }

TEST(TensionAtNodes, IsTheMeanOfTheirEdges) {
  const Eigen::VectorXd tension = (Eigen::VectorXd(3) << 2.0, 4.0, -1.0).finished();
  EXPECT_EQ(tension_at_nodes(tension), (Eigen::VectorXd(4) << 2.0, 3.0, 1.5, -1.0).finished());
  EXPECT_EQ(tension_at_nodes(Eigen::VectorXd()).size(), 0);
}

/// A polygon's is that of the circle inside it: larger than the curve's by a quarter of the square of half the angle
/// between two edges at most, here 1e-3.
TEST(CurvatureAtNodes, OfAHelixIsThatOfTheCurve) {
  const double radius = 0.002, a = 0.05, b = 0.01;  // of `helix`: its radius and its rise in a radian
  const int nodes = 200;
  const Eigen::VectorXd curvature = curvature_at_nodes(helix(nodes), radius);
  const double expected = radius * a / (a * a + b * b);
  EXPECT_NEAR(curvature.segment(1, nodes - 2).minCoeff(), expected, 1e-3 * expected);
  EXPECT_NEAR(curvature.segment(1, nodes - 2).maxCoeff(), expected, 1e-3 * expected);
  EXPECT_EQ(curvature[0], 0.0);
  EXPECT_EQ(curvature[nodes - 1], 0.0);
}

TEST(ContactMarker, LinesAreAsLongAsTheForces) {
  const std::vector<ContactForce> forces = {{Vec3(1.0, 0.0, 0.0), Vec3(0.0, 3.0, 0.0)},
                                            {Vec3(0.0, 1.0, 0.0), Vec3(0.0, 0.0, -6.0)}};
  const auto marker = contact_marker(forces, 0.01, 6.0, 0.05);
  ASSERT_EQ(marker.points.size(), 4u);
  EXPECT_NEAR((vec(marker.points[1]) - vec(marker.points[0]) - Vec3(0.0, 0.05, 0.0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((vec(marker.points[3]) - vec(marker.points[2]) - Vec3(0.0, 0.0, -0.1)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((0.5 * (vec(marker.points[0]) + vec(marker.points[1])) - forces[0].place).norm(), 0.0, 1e-15);
}

class ScenePictureTest : public testing::Test {
 protected:
  visualization_msgs::MarkerArray draw(const Points& points, double tension = 1.0) {
    const Eigen::VectorXd tensions = Eigen::VectorXd::Constant(points.cols() - 1, tension);
    const SceneView view{points, tensions, contacts, Vec3::Zero(), Vec3::UnitZ(), sample, "sliding"};
    return picture.draw(view, ros::Time(1.0));
  }
  static visualization_msgs::Marker part(const visualization_msgs::MarkerArray& all, const std::string& name) {
    for (const auto& marker : all.markers)
      if (marker.ns == name) return marker;
    ADD_FAILURE() << name;
    return {};
  }

  std::vector<ContactForce> contacts;
  Sample sample;
  ScenePicture picture{MachineOptions(), 0.002};
};

/// They are painted on the rod: where its nodes go, they go.
TEST_F(ScenePictureTest, GaugeMarksGoWithTheRod) {
  const Points before = helix(301);
  picture.begin(before);
  Points after = before;
  after.row(0).array() += 0.3;
  const auto marks_before = part(draw(before), "gauge_marks"), marks_after = part(draw(after), "gauge_marks");
  ASSERT_GT(marks_before.points.size(), 0u);
  ASSERT_EQ(marks_before.points.size(), marks_after.points.size());
  for (std::size_t i = 0; i < marks_before.points.size(); ++i) {
    const Vec3 way = vec(marks_after.points[i]) - vec(marks_before.points[i]);
    EXPECT_NEAR((way - Vec3(0.3, 0.0, 0.0)).norm(), 0.0, 1e-12);
  }
}

TEST_F(ScenePictureTest, TextSaysWhereTheTestIsAndWhereTheColoursEnd) {
  sample.phase = Phase::kPull;
  sample.load = 12.5;
  sample.knot_distance = 0.1;
  picture.begin(helix(50));
  draw(helix(50), 40.0);
  const std::string text = part(draw(helix(50), 20.0), "reading").text;
  for (const char* words : {"pull", "F = 12.5 N", "e = 100.0 mm", "sliding", "red: 40 N"})
    EXPECT_NE(text.find(words), std::string::npos) << words << " is not in:\n" << text;
  picture.color_by(ColorBy::kCurvature);
  EXPECT_NE(part(draw(helix(50)), "reading").text.find("radii"), std::string::npos);
}

/// Of the straight rod's 100 edges the one that parted is missing, and the two new ends are closed.
TEST_F(ScenePictureTest, ARodThatPartedHasAGap) {
  Points rod = Points::Zero(3, 101);
  rod.row(2) = Eigen::RowVectorXd::LinSpaced(101, 0.0, 1.0);
  picture.begin(rod);
  const double whole = enclosed_volume(part(draw(rod), "rod"));
  sample.break_arclength = 0.305;
  const auto marker = part(draw(rod), "rod");
  EXPECT_NEAR(enclosed_volume(marker), 0.99 * whole, 1e-9 * whole);
  for (const auto& point : marker.points) EXPECT_FALSE(point.z > 0.3 + 1e-9 && point.z < 0.31 - 1e-9) << point.z;
}

TEST_F(ScenePictureTest, ForcesThatAreNotShownAreTakenAway) {
  picture.begin(helix(50));
  contacts = {{Vec3::Zero(), Vec3::UnitX()}};
  EXPECT_EQ(part(draw(helix(50)), "contact_forces").action, visualization_msgs::Marker::ADD);
  picture.show_contacts(false);
  EXPECT_EQ(part(draw(helix(50)), "contact_forces").action, visualization_msgs::Marker::DELETE);
}

}  // namespace
}  // namespace knot_utm
