#include "knot_utm/ros/markers.hpp"

#include <gtest/gtest.h>
#include <ros/serialization.h>

#include <Eigen/Geometry>
#include <cmath>

#include "knot_utm/method/method.hpp"
#include "knot_utm/settings/step_settings.hpp"
#include "knot_utm/specimen/knot.hpp"

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

/// Along z from 0 to `length`.
Points straight(int nodes, double length) {
  Points points = Points::Zero(3, nodes);
  points.row(2) = Eigen::RowVectorXd::LinSpaced(nodes, 0.0, length);
  return points;
}

/// Straight ropes of 51 nodes and 1 m: the first one along x = 0, the second one along x = 0.5, with the edge 50
/// between them.
Points two_ropes() {
  Points both(3, 102);
  both << straight(51, 1.0), straight(51, 1.0);
  both.row(0).tail(51).setConstant(0.5);
  return both;
}

TEST(TubeMarker, ClosedSurfaceWindsOutwards) {
  const double radius = 0.002;
  const Points points = helix(400);
  const double length = (points.rightCols(399) - points.leftCols(399)).colwise().norm().sum();
  const auto marker = tube_marker(points, Colors(400), radius, {}, 12);
  // A regular polygon of 12 sides in place of the circle.
  const double area = 6.0 * std::sin(3.14159265358979 / 6.0) * radius * radius;
  EXPECT_NEAR(enclosed_volume(marker), area * length, 0.01 * area * length);
  EXPECT_EQ(marker.colors.size(), marker.points.size());
}

TEST(CylinderMarkers, MeetOnTheOutsideOfABend) {
  const double radius = 0.01, turn = 0.6;
  Points bend = Points::Zero(3, 3);
  bend.col(0) << -1.0, 0.0, 0.0;
  bend.col(2) << std::cos(turn), std::sin(turn), 0.0;
  const auto cylinders = cylinder_markers(bend, Colors(3), radius, {});
  ASSERT_EQ(cylinders.size(), 2u);
  EXPECT_NEAR(cylinders[0].pose.position.x + 0.5 * cylinders[0].scale.z, radius * std::tan(0.5 * turn), 1e-12);
}

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

TEST(ContactMarker, LinesAreAsLongAsTheScaleSays) {
  const std::vector<ContactForce> forces = {{Vec3(1.0, 0.0, 0.0), Vec3(0.0, 3.0, 0.0)},
                                            {Vec3(0.0, 1.0, 0.0), Vec3(0.0, 0.0, -100.0)}};
  Material material;
  material.breaking_force = 100.0;
  const ColorScale scale = ColorScale::of_tension(material, LoadCellOptions());
  const auto marker = contact_marker(forces, 0.01, scale, 0.05);
  ASSERT_EQ(marker.points.size(), 4u);
  const Vec3 first(0.0, 0.1 * scale.place(3.0), 0.0), second(0.0, 0.0, -0.1);
  EXPECT_NEAR((vec(marker.points[1]) - vec(marker.points[0]) - first).norm(), 0.0, 1e-15);
  EXPECT_NEAR((vec(marker.points[3]) - vec(marker.points[2]) - second).norm(), 0.0, 1e-15);
  EXPECT_NEAR((0.5 * (vec(marker.points[0]) + vec(marker.points[1])) - forces[0].place).norm(), 0.0, 1e-15);
}

constexpr int kSides = 12;

class ScenePictureTest : public testing::Test {
 protected:
  ScenePictureTest() { picture.sides(kSides); }
  SceneView view(const Points& points, double tension = 1.0) const {
    const Eigen::VectorXd tensions = Eigen::VectorXd::Constant(points.cols() - 1, tension);
    return {points, tensions, contacts, Vec3::UnitZ(), sample, ros::Time(1.0)};
  }
  /// The marker of this name in a picture.
  visualization_msgs::Marker marker(const char* name, const Points& points, double tension = 1.0) const {
    for (const auto& one : picture.draw(view(points, tension)).markers)
      if (one.ns == name) return one;
    ADD_FAILURE() << name;
    return {};
  }

  std::vector<ContactForce> contacts;
  Sample sample;
  static Material material() {
    Material rod;
    rod.radius = 0.002;
    rod.breaking_force = 500.0;
    return rod;
  }
  ScenePicture picture{SpecimenOptions(), MachineOptions(), material()};
};

/// They are painted on the rod: where its nodes go, they go.
TEST_F(ScenePictureTest, GaugeMarksGoWithTheRod) {
  const Points before = helix(301);
  picture.begin(before);
  Points after = before;
  after.row(0).array() += 0.3;
  const Vec3 way = vec(marker("gauge_marks", after).pose.position) - vec(marker("gauge_marks", before).pose.position);
  EXPECT_NEAR((way - Vec3(0.3, 0.0, 0.0)).norm(), 0.0, 1e-12);
}

/// Of a rod that has parted no tension is known: all of it has one colour, whatever its tension was, and no value of
/// the scale has that colour. Its bends are known.
TEST_F(ScenePictureTest, ARodThatPartedHasNoColourOfAForce) {
  picture.begin(helix(50));
  const auto colours = [&](double tension) { return marker("rod", helix(50), tension).colors; };
  const auto whole = colours(4.0);
  sample.break_arclength = 0.01;
  const auto parted = colours(4.0);
  EXPECT_EQ(parted, colours(400.0));
  EXPECT_EQ(parted, colours(Sample::kNone));
  EXPECT_NE(parted.front(), whole.front());
  const Points rod = straight(50, 0.5);
  picture.begin(rod);
  picture.sides(0);
  const auto unknown = marker("rod", rod, 4.0).color;
  picture.sides(kSides);
  for (double force = -500.0; force <= 500.0; force += 0.5) ASSERT_NE(picture.scale().color(force), unknown) << force;
  picture.color_by(ColorBy::kCurvature);
  EXPECT_EQ(marker("rod", rod).colors.front(), marker("rod", rod, 9.0).colors.front());
  EXPECT_NE(marker("rod", rod).colors.front(), parted.front());
}

/// A gap as wide as two rods is seen: edges of 1 mm that lie less than 4 mm from the break are missing, and the two new
/// ends are closed. No force between strands is known any more.
TEST_F(ScenePictureTest, ARodThatPartedHasAGap) {
  const Points rod = straight(1001, 1.0);
  picture.begin(rod);
  contacts = {{Vec3::Zero(), Vec3::UnitX()}};
  const double whole = enclosed_volume(marker("rod", rod));
  sample.break_arclength = 0.3055;
  EXPECT_NEAR(enclosed_volume(marker("rod", rod)), 0.991 * whole, 1e-9 * whole);
  picture.sides(0);
  for (const auto& one : picture.draw(view(rod)).markers) {
    EXPECT_NE(one.ns, "contact_forces");
    EXPECT_TRUE(one.ns != "rod" || std::abs(one.pose.position.z - 0.3055) > 0.5 * one.scale.z + 0.004);
  }
}

/// Nothing is drawn from one rope to the other, and they have the colours of their own tensions to their ends. The
/// place of a break counts along both.
TEST_F(ScenePictureTest, RopesAreDrawnEachByItself) {
  const Points both = two_ropes();
  picture.begin(both, {50});
  const auto count = [](const visualization_msgs::Marker& triangles) {
    for (const auto& point : triangles.points) EXPECT_LT(std::min(std::abs(point.x), std::abs(point.x - 0.5)), 0.003);
    return triangles.points.size();
  };
  EXPECT_EQ(count(marker("rod", both)), 2u * 3u * 6u * kSides);
  Eigen::VectorXd tension = Eigen::VectorXd::Constant(101, 3.0);
  tension[50] = 0.0;
  EXPECT_EQ(tension_at_nodes(tension, {50}), Eigen::VectorXd::Constant(102, 3.0));
  EXPECT_EQ(curvature_at_nodes(both, 0.002, {50}).maxCoeff(), 0.0);
  sample.break_arclength = 1.31;
  for (const auto& point : marker("rod", both).points)
    EXPECT_FALSE(point.x > 0.25 && point.z > 0.3 + 1e-9 && point.z < 0.32 - 1e-9);
}

TEST_F(ScenePictureTest, RopesOfAnotherMaterialHaveTheirOwnRadius) {
  const Points both = two_ropes();
  Material two = material(), thin = material();
  thin.radius = 0.001;
  two.other = std::make_shared<const Material>(thin);
  picture = ScenePicture(SpecimenOptions(), MachineOptions(), two);
  picture.sides(kSides);
  picture.begin(both, {50});
  double widest[2] = {0.0, 0.0};
  for (const auto& point : marker("rod", both).points) {
    double& of = widest[point.x < 0.25 ? 0 : 1];
    of = std::max(of, std::hypot(point.x - (point.x < 0.25 ? 0.0 : 0.5), point.y));
  }
  EXPECT_NEAR(widest[0], 0.002, 1e-12);
  EXPECT_NEAR(widest[1], 0.001, 1e-12);
  picture.sides(0);
  std::vector<std::pair<double, double>> rows;  // diameter and x
  for (const auto& row : picture.draw(view(both)).markers)
    if (row.ns == "rod") rows.emplace_back(row.scale.x, row.pose.position.x);
  EXPECT_EQ(rows, (std::vector<std::pair<double, double>>{{0.004, 0.0}, {0.002, 0.5}}));
}

/// Its axis is the cylinder's, which stands along z before the marker's pose turns it.
TEST_F(ScenePictureTest, APostIsACylinderWhereTheSpecimenHasIt) {
  SpecimenOptions capstan = knot_of(knot_named("capstan")).defaults(material().radius);
  capstan.knot = knot_named("capstan");
  capstan.wrap = 4.0 * M_PI;
  MachineOptions machine;
  machine.grips = GripKind::kNodes;
  picture = ScenePicture(capstan, machine, material());
  picture.begin(helix(50));
  const auto post = picture.bodies().markers[1];
  EXPECT_EQ(post.header.frame_id, "lower_grip");
  EXPECT_EQ(post.type, visualization_msgs::Marker::CYLINDER);
  EXPECT_EQ(post.scale.x, capstan.post_diameter);
  EXPECT_EQ(post.scale.y, capstan.post_diameter);
  const auto& q = post.pose.orientation;
  const Vec3 axis = Eigen::Quaterniond(q.w, q.x, q.y, q.z) * Vec3::UnitZ();
  const Vec3 wanted = knot_of(capstan).supports(capstan, material()).posts.front().axis;
  EXPECT_NEAR((axis - wanted).norm(), 0.0, 1e-12);
}

/// Each picture takes the one before away.
TEST_F(ScenePictureTest, ForcesThatAreNotShownAreTakenAway) {
  picture.begin(helix(50));
  contacts = {{Vec3::Zero(), Vec3::UnitX()}};
  EXPECT_EQ(marker("contact_forces", helix(50)).points.size(), 2u);
  picture.show_contacts(false);
  const auto without = picture.draw(view(helix(50))).markers;
  EXPECT_EQ(without.front().action, visualization_msgs::Marker::DELETEALL);
  for (const auto& one : without) EXPECT_NE(one.ns, "contact_forces");
}

/// The shipped test at its mesh, in all colours and with as many contacts as its knots have when they have locked.
TEST_F(ScenePictureTest, OfTheShippedTestItHasAHundredKilobytesAtMost) {
  const Method method = load_method(std::string(KNOT_UTM_SOURCE_DIR) + "/config/tighten.yaml");
  const Centreline rod = specimen_centreline(method.specimen, method.material, method.machine, method.physics);
  picture = ScenePicture(method.specimen, method.machine, method.material);
  picture.begin(rod.points, rod.cuts);
  contacts.resize(300);
  SceneView shown = view(rod.points);
  shown.tension = Eigen::VectorXd::LinSpaced(rod.points.cols() - 1, 0.0, *method.material.breaking_force);
  EXPECT_LE(ros::serialization::serializationLength(picture.draw(shown)), 100000u);
}

/// The frame that a camera follows: a knot between straight ends, wherever it is; of a straight rod the middle.
TEST_F(ScenePictureTest, TheKnotIsWhereTheRodIsBentMost) {
  Points rod(3, 160);
  rod << straight(100, 0.4), (0.1 * helix(50)).colwise() + Vec3(0.0, 0.0, 0.4),
      straight(10, 0.04).colwise() + Vec3(0.0, 0.0, 0.43);
  picture.begin(rod);
  EXPECT_NEAR((picture.knot(rod) - Vec3(0.0, 0.0, 0.406)).norm(), 0.0, 0.01);
  EXPECT_NEAR((picture.knot(straight(101, 1.0)) - Vec3(0.0, 0.0, 0.5)).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace knot_utm
