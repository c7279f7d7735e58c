#include "knot_utm/specimen/knot_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "knot_utm/rod/material.hpp"
#include "knot_utm/specimen/fisherman.hpp"
#include "knot_utm/specimen/overhand.hpp"

namespace knot_utm {
namespace {

constexpr double kRadius = 3.175e-3;

Centreline open_overhand() {
  OverhandShape shape;
  shape.length = 0.7;
  shape.end_to_end = 0.4;
  return overhand(shape);
}

/// The rod drawn towards a straight line: at 1 its knot is gone, and its strands have run through each other.
Points straightened(const Points& points, double share) {
  const Eigen::Index n = points.cols();
  Points result = points;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(n - 1);
    const Vec3 line = (1.0 - t) * points.col(0) + t * points.col(n - 1);
    result.col(i) += share * (line - result.col(i));
  }
  return result;
}

TEST(KnotWatch, AnOverhandIsLostOnceItIsStraightAndStaysLost) {
  const Points start = open_overhand().points;
  KnotWatch watch({}, kRadius, start);
  EXPECT_EQ(watch.follow(straightened(start, 0.05)), KnotType::kKept);
  EXPECT_EQ(watch.follow(straightened(start, 0.99)), KnotType::kChanged);
  EXPECT_EQ(watch.follow(start), KnotType::kChanged);
}

/// An arch, a helix or a hairpin has no knot: whatever its ends are joined to, none comes undone.
TEST(KnotWatch, ARodWithoutAKnotHasNoneToLose) {
  const Points knotted = open_overhand().points;
  KnotWatch watch({}, kRadius, straightened(knotted, 0.99));
  EXPECT_EQ(watch.follow(knotted), KnotType::kKept);
  EXPECT_EQ(watch.follow(straightened(knotted, 0.99)), KnotType::kKept);
}

/// Thin, flattened strands make coils that are shorter than round strands could: space is pressed together about one.
TEST(KnotWatch, ACoilOfSoftStrandsIsFollowedByWhatTheyLeaveOfTheirRadius) {
  const Centreline line = fisherman_loop({});
  const std::vector<int> standing{line.nearest_node(line.knots[0].standing_begin),
                                  line.nearest_node(line.knots[1].standing_begin)};
  const double middle = line.points(2, line.nearest_node(line.knots[1].coil_middle));
  Points points = line.points;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const double up = (points(2, i) - middle) / kRadius, far = std::abs(up);
    const double pressed = far < 5.0 ? 0.2 * far : far < 15.0 ? 1.0 + 1.4 * (far - 5.0) : far;
    points(2, i) = middle + kRadius * std::copysign(pressed, up);
  }
  RodMaterial soft;
  soft.radius = kRadius;
  EXPECT_EQ(KnotWatch(standing, soft.core_radius(), line.points).follow(points), KnotType::kChanged);
  soft.section = CrossSection::kSoft;
  EXPECT_EQ(KnotWatch(standing, soft.core_radius(), line.points).follow(points), KnotType::kKept);
}

TEST(KnotWatch, ATailThatSlipsOutOfItsCoilUnties) {
  const Centreline line = fisherman_loop({});
  const int lower = line.nearest_node(line.knots[0].standing_begin);
  const int upper = line.nearest_node(line.knots[1].standing_begin);
  const double edge = (line.points.col(1) - line.points.col(0)).norm();
  KnotWatch watch({lower, upper}, kRadius, line.points);
  Points points = line.points;
  points.row(0).array() += kRadius;
  EXPECT_EQ(watch.follow(points), KnotType::kKept);
  // The upper knot's own strand drawn straight down through its coil.
  const Eigen::Index last = points.cols() - 1;
  for (Eigen::Index i = upper; i <= last; ++i) {
    points.col(i) = points.col(upper) + static_cast<double>(i - upper) * edge * Vec3::UnitZ();
  }
  EXPECT_EQ(watch.follow(points), KnotType::kChanged);
}

}  // namespace
}  // namespace knot_utm
