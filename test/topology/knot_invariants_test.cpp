#include "knot_utm/topology/knot_invariants.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <deque>
#include <random>

#include "knot_utm/specimen/fisherman.hpp"
#include "knot_utm/specimen/overhand.hpp"
#include "knot_utm/topology/knot_hole.hpp"
#include "reference.hpp"

namespace knot_utm {
namespace {

const KnotPolynomial kSamePolynomial{1, -1, -1, 4, -5, 4, -1, -1, 1};
const KnotPolynomial kOppositePolynomial{1, -1, -1, 3, -1, -1, 1};

/// A smooth map of space onto itself, near enough to the identity to be one to one.
Points waved(const Points& points, double wavelength, double slope, std::mt19937& random) {
  std::normal_distribution<double> normal;
  Points result = points;
  for (int wave = 0; wave < 3; ++wave) {
    const Vec3 direction = Vec3(normal(random), normal(random), normal(random)).normalized();
    const Vec3 shift = Vec3(normal(random), normal(random), normal(random)).normalized();
    const double phase = normal(random);
    const double k = 2.0 * M_PI / wavelength;
    const Eigen::RowVectorXd sine = ((k * direction.transpose() * points).array() + phase).sin();
    result += (slope / 3.0 / k) * shift * sine;
  }
  return result;
}

/// A closed polygon's torus knot or link component winding p times around the axis and q times around the core.
Points torus_knot(int p, int q, int points) {
  Points knot(3, points);
  for (int i = 0; i < points; ++i) {
    const double t = 2.0 * M_PI * i / points;
    const double r = 2.0 + std::cos(q * t);
    knot.col(i) << r * std::cos(p * t), r * std::sin(p * t), std::sin(q * t);
  }
  return knot;
}

TEST(AlexanderPolynomial, OfKnownKnots) {
  EXPECT_EQ(alexander_polynomial(torus_knot(1, 0, 60)), KnotPolynomial({1}));
  EXPECT_EQ(alexander_polynomial(torus_knot(1, 5, 200)), KnotPolynomial({1}));
  EXPECT_EQ(alexander_polynomial(torus_knot(2, 3, 100)), KnotPolynomial({1, -1, 1}));
  EXPECT_EQ(alexander_polynomial(torus_knot(2, -3, 100)), KnotPolynomial({1, -1, 1}));
  EXPECT_EQ(alexander_polynomial(torus_knot(2, 5, 200)), KnotPolynomial({1, -1, 1, -1, 1}));
  EXPECT_EQ(alexander_polynomial(torus_knot(3, 4, 300)), KnotPolynomial({1, -1, 0, 1, 0, -1, 1}));
  // Figure eight.
  Points eight(3, 200);
  for (int i = 0; i < 200; ++i) {
    const double t = 2.0 * M_PI * i / 200;
    const double r = 2.0 + std::cos(2.0 * t);
    eight.col(i) << r * std::cos(3.0 * t), r * std::sin(3.0 * t), std::sin(4.0 * t);
  }
  EXPECT_EQ(alexander_polynomial(eight), KnotPolynomial({-1, 3, -1}));
  EXPECT_EQ(knot_determinant({-1, 3, -1}), 5);
}

TEST(LinkingNumber, OfTwoStrandsOfATorusLinkAndOfDistantRings) {
  for (const int q : {-2, 0, 1, 3}) {
    Points first(3, 120);
    Points second(3, 120);
    for (int i = 0; i < 120; ++i) {
      const double t = 2.0 * M_PI * i / 120;
      for (const double phase : {0.0, M_PI}) {
        const double r = 2.0 + std::cos(q * t + phase);
        (phase > 0.0 ? first : second).col(i) << r * std::cos(t), r * std::sin(t), std::sin(q * t + phase);
      }
    }
    EXPECT_EQ(std::abs(linking_number(first, second)), std::abs(q));
    EXPECT_EQ(linking_number(first, second), linking_number(second, first));
    second.colwise() += Vec3(20.0, 0.0, 0.0);
    EXPECT_EQ(linking_number(first, second), 0);
  }
}

TEST(K7_Overhand, IsATorusKnotOnceItsEndsAreJoinedOutside) {
  for (int turns = 1; turns <= 4; ++turns) {
    for (const double excess : {0.65, 1.0}) {
      OverhandShape shape;
      shape.turns = turns;
      shape.length = 2.0;
      shape.end_to_end = shape.length - excess;
      KnotPolynomial expected;
      for (int i = 0; i <= 2 * turns; ++i) expected.push_back(i % 2 == 0 ? 1 : -1);
      const KnotPolynomial found = alexander_polynomial(closed_far_away(overhand(shape).points, Vec3::UnitZ()));
      EXPECT_EQ(found, expected);
      if (turns == 1) hold_against("K7 overhand: determinant", 3, static_cast<double>(knot_determinant(found)), 0.0);
    }
  }
}

/// A sketched loop of either handedness.
class K7_Loop : public testing::TestWithParam<Handedness> {
 protected:
  FishermanShape shape = [] {
    FishermanShape out;
    out.handedness = GetParam();
    return out;
  }();

  /// Draws the loop of `shape`.
  void draw() {
    line = fisherman_loop(shape);
    topology = LoopTopology(node(line.knots[0].standing_begin), node(line.knots[1].standing_begin), shape.radius);
  }
  void SetUp() override { draw(); }

  Eigen::Index node(double arclength) const { return line.nearest_node(arclength); }
  LoopTopology::Reading read(const Points& points) { return topology.read(points, Vec3::UnitZ()); }
  void expect_fisherman(const LoopTopology::Reading& reading) const {
    const bool same = GetParam() == Handedness::kSame;
    EXPECT_EQ(reading.polynomial, same ? kSamePolynomial : kOppositePolynomial);
    EXPECT_EQ(reading.determinant, same ? 11 : 1);
    EXPECT_EQ(std::abs(reading.linking), same ? 2 : 0);
    EXPECT_THAT(reading.overhand_determinant, testing::ElementsAre(3, 3));
    EXPECT_THAT(reading.coil_found, testing::ElementsAre(true, true));
  }

  /// Turns nodes around the strand that passes the upper knot: not at all at `first`, by the full angle from `full` on.
  Points wound(Eigen::Index first, Eigen::Index full, double angle) const {
    Points points = line.points;
    const Vec3 strand = points.col(node(line.knots[1].threaded));
    for (Eigen::Index i = first; i < points.cols(); ++i) {
      const double share = std::min(1.0, static_cast<double>(i - first) / static_cast<double>(full - first));
      const Vec3 hub(strand.x(), strand.y(), points(2, i));
      points.col(i) = hub + Eigen::AngleAxisd(angle * share, Vec3::UnitZ()) * (points.col(i) - hub);
    }
    return points;
  }

  Centreline line;
  LoopTopology topology{0, 0, 1.0};
};

TEST_P(K7_Loop, DeterminantAndLinkingOfTheDrawnKnot) {
  const LoopTopology::Reading reading = read(line.points);
  expect_fisherman(reading);
  const bool same = GetParam() == Handedness::kSame;
  const std::string what = same ? "K7 same-handed loop: " : "K7 opposite-handed loop: ";
  hold_against(what + "determinant", same ? 11 : 1, static_cast<double>(reading.determinant), 0.0);
  hold_against(what + "size of the linking number of its halves", same ? 2 : 0, std::abs(reading.linking), 0.0);
  for (int knot = 0; knot < 2; ++knot)
    hold_against(what + "determinant of overhand " + std::to_string(knot + 1), 3,
                 static_cast<double>(reading.overhand_determinant[static_cast<std::size_t>(knot)]), 0.0);
}

TEST_P(K7_Loop, HasItsKnotTypeAtAnyLoosenessAndMesh) {
  const double h = shape.radius;
  for (const double looseness : {4.2, 4.7, 5.1})
    for (const double edge : {0.5, 1.0})
      for (const double e : {0.06, 0.15}) {
        shape.looseness = looseness;
        shape.edge_length = edge * h;
        shape.knot_distance = e;
        draw();
        expect_fisherman(read(line.points));
      }
}

TEST_P(K7_Loop, KeepsItUnderSmoothDeformationAndRotation) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int n = 0; n < 30; ++n) {
    const Points wave = waved(line.points, n % 2 == 0 ? 0.2 : 0.05, n % 2 == 0 ? 0.4 : 0.2, random);
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
    const Points turned = (turn.toRotationMatrix() * wave).colwise() + Vec3(0.3, -0.2, 5.0);
    expect_fisherman(LoopTopology(topology).read(turned, turn * Vec3::UnitZ()));
  }
}

TEST_P(K7_Loop, KeepsItWhileATailOrAWholeKnotWindsAroundTheOtherStrand) {
  shape.tail = 0.1;
  shape.knot_distance = 0.15;
  draw();
  const Eigen::Index exit = node(line.knots[1].tail_exit), standing = node(line.knots[1].standing_begin);
  const LoopTopology sketched = topology;
  for (const double sense : {-1.0, 1.0})
    for (const auto& [first, full] : {std::pair(exit, exit + 20), std::pair(standing - 25, standing)}) {
      topology = sketched;
      for (double angle = 0.0; angle < 4.0 * M_PI; angle += 0.5)
        expect_fisherman(read(wound(first, full, sense * angle)));
    }
}

TEST_P(K7_Loop, KeepsItWhereAKnotTurnedFurtherThanCouldBeFollowed) {
  shape.knot_distance = 0.15;
  draw();
  const Eigen::Index full = node(line.knots[1].standing_begin);
  const LoopTopology::Reading tied = read(line.points);
  const Points turned = wound(full - 25, full, 2.0 * M_PI);
  EXPECT_FALSE(LoopTopology(topology).read(turned, Vec3::UnitZ()).same_knot(tied));
  expect_fisherman(topology.read_as(tied, turned, Vec3::UnitZ()));
  expect_fisherman(read(turned));
}

TEST_P(K7_Loop, LosesItWhenATailLeavesItsCoil) {
  const LoopTopology::Reading tied = read(line.points);
  // The tail pulled back into the coil, and out of it sideways.
  Points points = line.points;
  const Eigen::Index middle = node(line.knots[1].coil_middle);
  const Vec3 from = points.col(middle);
  const Vec3 sideways = (from - points.col(node(line.knots[1].threaded))).normalized();
  for (Eigen::Index i = middle + 1; i < points.cols(); ++i)
    points.col(i) = points.col(i - 1) + (line.points.col(1) - line.points.col(0)).norm() * sideways;
  const LoopTopology::Reading lost = topology.read_as(tied, points, Vec3::UnitZ());
  EXPECT_FALSE(lost.same_knot(tied));
  EXPECT_EQ(lost.overhand_determinant[0], 3);
  EXPECT_EQ(lost.overhand_determinant[1], 1);
  EXPECT_NE(lost.polynomial, tied.polynomial);
}

INSTANTIATE_TEST_SUITE_P(Hands, K7_Loop, testing::Values(Handedness::kSame, Handedness::kOpposite),
                         [](const auto& hand) { return hand.param == Handedness::kSame ? "Same" : "Opposite"; });

constexpr double kRadius = 1.0;  // h of the rods here

Points sketched(const std::vector<Vec3>& places) {
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
  return sketched(places);
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
  return sketched(places);
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
  EXPECT_EQ(hole_diameter(sketched(straight), kRadius), 0.0);
  EXPECT_EQ(hole_diameter(sketched(arch), kRadius), 0.0);
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
    const Points points = sketched(places);
    constexpr double kCell = 0.15;  // the curve's points are nearer to each other than that
    const double flooded = by_flooding(points, Mat3::Identity(), kCell);
    const double found = largest_enclosed_circle(points, Mat3::Identity(), 1e-3).radius;
    // Cells nearer to the curve than one are taken for enclosed, and the best place lies between cells.
    EXPECT_NEAR(found, flooded, 1.5 * kCell) << curve;
  }
}

}  // namespace
}  // namespace knot_utm
