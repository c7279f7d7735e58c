#include "knot_utm/topology/knot_invariants.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "knot_utm/specimen/fisherman.hpp"
#include "knot_utm/specimen/overhand.hpp"
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

/// A drawn loop of either handedness.
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
  const LoopTopology drawn = topology;
  for (const double sense : {-1.0, 1.0})
    for (const auto& [first, full] : {std::pair(exit, exit + 20), std::pair(standing - 25, standing)}) {
      topology = drawn;
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

}  // namespace
}  // namespace knot_utm
