// What is read of a knot: loops and braids of shapes that are known in closed form, and of others by brute force.
#include "knot_utm/specimen/knot_readings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "knot_utm/rod/material.hpp"
#include "knot_utm/specimen/fisherman.hpp"
#include "knot_utm/specimen/knot_watch.hpp"
#include "knot_utm/specimen/overhand.hpp"
#include "knot_utm/specimen/polyline.hpp"

namespace knot_utm {
namespace {

constexpr double kRadius = 0.003, kReach = 1.05 * 2.0 * kRadius, kApart = 1.5 * M_PI * kRadius;
constexpr KnotReading::Kind kLoop = KnotReading::Kind::kLoop, kBetween = KnotReading::Kind::kBetween,
                            kDistance = KnotReading::Kind::kDistance;

RodProperties rod_of(const Points& points, const std::vector<int>& cuts = {}) {
  RodMaterial material;
  material.radius = kRadius;
  material.density = 1000.0;
  Eigen::VectorXd rest(points.cols() - 1);
  for (Eigen::Index i = 0; i < rest.size(); ++i) rest[i] = (points.col(i + 1) - points.col(i)).norm();
  return make_rod(material, rest, cuts);
}

PerKnot read(const Points& points, std::vector<KnotReading> what, const std::vector<int>& cuts = {}) {
  Centreline rod;
  rod.points = points;
  rod.readings = std::move(what);
  return KnotReadings(rod, rod_of(points, cuts)).at(points);
}

/// A line that goes up to the right, three quarters of a circle to whose ends it and the next line are tangents, and
/// that line, which crosses the first one at right angles in the origin, `gap` above it.
struct Teardrop {
  static constexpr int kOnLine = 31, kOnArc = 90;             // edges
  static constexpr double kTangent = 0.05, kBeyond = 0.0612;  // of a line, to either side of the crossing [m]
  double gap = 0.0;

  Points points() const {
    const Vec3 up = Vec3(1, 1, 0).normalized(), down = Vec3(-1, 1, 0).normalized();
    Points out(3, 2 * kOnLine + kOnArc + 1);
    Eigen::Index i = 0;
    for (int k = 0; k <= kOnLine; ++k) out.col(i++) = (k * (kTangent + kBeyond) / kOnLine - kBeyond) * up;
    const double r = kTangent, from = 0.75 * M_PI;
    for (int k = 1; k <= kOnArc; ++k) {
      const double turned = from - 1.5 * M_PI * k / kOnArc;
      out.col(i++) = Vec3(std::sqrt(2.0) * r + r * std::cos(turned), r * std::sin(turned), gap * k / kOnArc);
    }
    const Vec3 end = out.col(i - 1);
    for (int k = 1; k <= kOnLine; ++k) out.col(i++) = end + k * (kTangent + kBeyond) / kOnLine * down;
    return out;
  }
  double arc() const {
    const double chord = 2.0 * kTangent * std::sin(0.75 * M_PI / kOnArc);
    return kOnArc * std::hypot(chord, gap / kOnArc);
  }
  /// At right angles a place of one line is hypot(x, gap) away from the other line.
  double touches_before_crossing() const { return std::sqrt(kReach * kReach - gap * gap); }
  double loop() const { return 2.0 * (kTangent - touches_before_crossing()) + arc(); }
};

TEST(KnotReadings, OfATeardropThatTouchesWhereItCrossesIsItsArcAndTwoTangents) {
  for (const double gap : {2.0 * kRadius, 1.9 * kRadius, 2.09 * kRadius}) {
    const Teardrop drop{gap};
    const Points points = drop.points();
    // Wherever in the loop the landmark is.
    for (const int node : {Teardrop::kOnLine, Teardrop::kOnLine + 45, Teardrop::kOnLine + 80})
      EXPECT_NEAR(read(points, {{kLoop, node, node}})[0], drop.loop(), 1e-9) << gap;
  }
}

TEST(KnotReadings, BetweenIsFromTheEndOfOneLoopToTheBeginOfTheOther) {
  const Teardrop drop{2.0 * kRadius};
  const Points points = drop.points();
  const int last = static_cast<int>(points.cols()) - 1, eye = Teardrop::kOnLine + 45;
  // From the first node to the eye: what touches at the crossing. Either order of the landmarks; the distance, too.
  const PerKnot found =
      read(points, {{kBetween, 0, eye}, {kBetween, eye, 0}, {kBetween, 0, last}, {kDistance, 0, eye}});
  const double touching = 2.0 * drop.touches_before_crossing();
  EXPECT_NEAR(found[0], touching, 1e-9);
  EXPECT_NEAR(found[1], touching, 1e-9);
  EXPECT_NEAR(found[2], drop.loop() + 2.0 * touching, 1e-9);
  EXPECT_EQ(found[3], (points.col(eye) - points.col(0)).norm());
  // Both in one loop.
  EXPECT_EQ(read(points, {{kBetween, eye, eye + 10}})[0], 0.0);
}

/// A loop does not run on into the next rope. Here it hangs in another rope, which it touches at two places.
TEST(KnotReadings, EndsWhereItTouchesAnotherRope) {
  // A half circle of radius R in the plane y = 0 around the other rope, which runs along y: both legs pass it by.
  const int edges = 40;
  Points points(3, 2 * (edges + 1));
  const double step = 0.001;
  for (int i = 0; i <= edges; ++i) {
    points.col(i) = Vec3(step * (i - edges / 2), 0.0, 0.0);
    points.col(edges + 1 + i) = Vec3(0.0101, step * (i - edges / 2), 2.0 * kRadius);
  }
  const double before = std::sqrt(kReach * kReach - std::pow(2.0 * kRadius, 2));
  // From the landmark at x = 0 it touches at x = 0.0101 less that; downwards it touches nothing.
  const PerKnot found = read(points, {{kLoop, edges / 2, edges / 2}, {kBetween, edges / 2, edges}}, {edges});
  EXPECT_TRUE(std::isnan(found[0]));
  EXPECT_NEAR(found[1], 2.0 * before, 1e-9);
}

/// Brute force: both ways from the node in steps of a 400th of the radius, until a place is within reach of any edge
/// that is far enough along the rod.
double loop_by_steps(const Points& points, int node) {
  const std::vector<double> at = arclengths(points);
  const auto edges = static_cast<int>(points.cols()) - 1;
  const auto touches = [&](int i, const Vec3& x) {
    for (int j = 0; j < edges; ++j) {
      if (std::abs(at[j] + at[j + 1] - at[i] - at[i + 1]) < 2.0 * kApart) continue;
      const Vec3 a = points.col(j), b = points.col(j + 1) - points.col(j);
      const double u = std::clamp((x - a).dot(b) / b.squaredNorm(), 0.0, 1.0);
      if ((x - a - u * b).norm() < kReach) return true;
    }
    return false;
  };
  const auto walk = [&](int way) {
    for (int i = way > 0 ? node : node - 1; i >= 0 && i < edges; i += way) {
      const int from = way > 0 ? i : i + 1, steps = static_cast<int>(400.0 * (at[i + 1] - at[i]) / kRadius);
      for (int k = 0; k < steps; ++k) {
        const double t = static_cast<double>(k) / steps;
        if (touches(i, (1.0 - t) * points.col(from) + t * points.col(from + way)))
          return at[from] + t * (at[from + way] - at[from]);
      }
    }
    return PerKnot::kUnknown;
  };
  return walk(1) - walk(-1);
}

TEST(KnotReadings, AgreeWithBruteForceOnATangle) {
  Points points(3, 400);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const double t = 0.03 * static_cast<double>(i);
    points.col(i) = 0.02 * Vec3(std::sin(2.3 * t) + 0.3 * std::sin(5.1 * t), std::cos(1.7 * t + 0.4) + 0.2 * t,
                                std::sin(3.1 * t + 1.0));
  }
  int known = 0;
  for (int node = 20; node < 400; node += 19) {
    const double expected = loop_by_steps(points, node), found = read(points, {{kLoop, node, node}})[0];
    ASSERT_EQ(std::isnan(found), std::isnan(expected)) << node;
    if (std::isnan(found)) continue;
    ++known;
    EXPECT_NEAR(found, expected, 2.0 * kRadius / 400.0) << node;  // a step to either side
  }
  EXPECT_GT(known, 10);
}

constexpr double kRodRadius = 3.175e-3;

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
  KnotWatch watch({}, kRodRadius, start);
  EXPECT_EQ(watch.follow(straightened(start, 0.05)), KnotType::kKept);
  EXPECT_EQ(watch.follow(straightened(start, 0.99)), KnotType::kChanged);
  EXPECT_EQ(watch.follow(start), KnotType::kChanged);
}

/// An arch, a helix or a hairpin has no knot: whatever its ends are joined to, none comes undone.
TEST(KnotWatch, ARodWithoutAKnotHasNoneToLose) {
  const Points knotted = open_overhand().points;
  KnotWatch watch({}, kRodRadius, straightened(knotted, 0.99));
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
    const double up = (points(2, i) - middle) / kRodRadius, far = std::abs(up);
    const double pressed = far < 5.0 ? 0.2 * far : far < 15.0 ? 1.0 + 1.4 * (far - 5.0) : far;
    points(2, i) = middle + kRodRadius * std::copysign(pressed, up);
  }
  RodMaterial soft;
  soft.radius = kRodRadius;
  EXPECT_EQ(KnotWatch(standing, soft.core_radius(), line.points).follow(points), KnotType::kChanged);
  soft.section = CrossSection::kSoft;
  EXPECT_EQ(KnotWatch(standing, soft.core_radius(), line.points).follow(points), KnotType::kKept);
}

TEST(KnotWatch, ATailThatSlipsOutOfItsCoilUnties) {
  const Centreline line = fisherman_loop({});
  const int lower = line.nearest_node(line.knots[0].standing_begin);
  const int upper = line.nearest_node(line.knots[1].standing_begin);
  const double edge = (line.points.col(1) - line.points.col(0)).norm();
  KnotWatch watch({lower, upper}, kRodRadius, line.points);
  Points points = line.points;
  points.row(0).array() += kRodRadius;
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
