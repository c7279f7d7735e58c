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

Eigen::Index node_at(const Centreline& line, double arclength) { return line.nearest_node(arclength); }

LoopTopology topology_of(const Centreline& line, double radius) {
  return {node_at(line, line.knots[0].standing_begin), node_at(line, line.knots[1].standing_begin), radius};
}

void expect_fisherman(const LoopTopology::Reading& reading, Handedness handedness) {
  const bool same = handedness == Handedness::kSame;
  EXPECT_EQ(reading.polynomial, same ? kSamePolynomial : kOppositePolynomial);
  EXPECT_EQ(reading.determinant, same ? 11 : 1);
  EXPECT_EQ(std::abs(reading.linking), same ? 2 : 0);
  EXPECT_THAT(reading.overhand_determinant, testing::ElementsAre(3, 3));
  EXPECT_THAT(reading.coil_found, testing::ElementsAre(true, true));
}

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

class K7_Loop : public testing::TestWithParam<Handedness> {};

TEST_P(K7_Loop, DeterminantAndLinkingOfTheDrawnKnot) {
  FishermanShape shape;
  shape.handedness = GetParam();
  const Centreline line = fisherman_loop(shape);
  const LoopTopology::Reading reading = topology_of(line, shape.radius).read(line.points, Vec3::UnitZ());
  expect_fisherman(reading, GetParam());
  const bool same = GetParam() == Handedness::kSame;
  const std::string what = same ? "K7 same-handed loop: " : "K7 opposite-handed loop: ";
  hold_against(what + "determinant", same ? 11 : 1, static_cast<double>(reading.determinant), 0.0);
  hold_against(what + "size of the linking number of its halves", same ? 2 : 0, std::abs(reading.linking), 0.0);
  for (int knot = 0; knot < 2; ++knot)
    hold_against(what + "determinant of overhand " + std::to_string(knot + 1), 3,
                 static_cast<double>(reading.overhand_determinant[static_cast<std::size_t>(knot)]), 0.0);
}

TEST_P(K7_Loop, HasItsKnotTypeAtAnyLoosenessAndMesh) {
  FishermanShape shape;
  shape.handedness = GetParam();
  for (const double looseness : {4.2, 4.7, 5.1}) {
    for (const double edge : {0.5, 0.75, 1.0}) {
      for (const double e : {0.06, 0.1, 0.15}) {
        shape.looseness = looseness;
        shape.edge_length = edge * shape.radius;
        shape.knot_distance = e;
        const Centreline line = fisherman_loop(shape);
        expect_fisherman(topology_of(line, shape.radius).read(line.points, Vec3::UnitZ()), GetParam());
      }
    }
  }
}

TEST_P(K7_Loop, KeepsItUnderSmoothDeformationAndRotation) {
  FishermanShape shape;
  shape.handedness = GetParam();
  const Centreline line = fisherman_loop(shape);
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int n = 0; n < 30; ++n) {
    const Points wave = waved(line.points, n % 2 == 0 ? 0.2 : 0.05, n % 2 == 0 ? 0.4 : 0.2, random);
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
    const Points turned = (turn.toRotationMatrix() * wave).colwise() + Vec3(0.3, -0.2, 5.0);
    LoopTopology topology = topology_of(line, shape.radius);
    const LoopTopology::Reading reading = topology.read(turned, turn * Vec3::UnitZ());
    expect_fisherman(reading, GetParam());
  }
}

/// Bends the tail of the upper knot, from its exit on, by `bend` towards the direction at `heading` from x.
Points with_bent_tail(const Centreline& line, double bend, double heading) {
  Points points = line.points;
  const Eigen::Index exit = node_at(line, line.knots[1].tail_exit) + 1;
  const Vec3 towards(std::cos(heading), std::sin(heading), 0.0);
  const Eigen::Index tail = points.cols() - exit;
  for (Eigen::Index i = exit; i < points.cols(); ++i) {
    const double angle = bend * std::min(1.0, 2.0 * static_cast<double>(i - exit) / static_cast<double>(tail));
    points.col(i) = points.col(i - 1) + (line.points.col(1) - line.points.col(0)).norm() *
                                            (std::cos(angle) * Vec3::UnitZ() + std::sin(angle) * towards);
  }
  return points;
}

TEST_P(K7_Loop, KeepsItWhileATailSwings) {
  FishermanShape shape;
  shape.handedness = GetParam();
  const Centreline line = fisherman_loop(shape);
  LoopTopology topology = topology_of(line, shape.radius);
  const double away = GetParam() == Handedness::kSame ? 0.0 : 0.5 * M_PI;
  for (double bend = 0.0; bend < 3.0; bend += 0.25) {
    for (double heading = -1.75; heading <= 1.75; heading += 0.25) {
      const LoopTopology::Reading reading = topology.read(with_bent_tail(line, bend, away + heading), Vec3::UnitZ());
      expect_fisherman(reading, GetParam());
    }
  }
}

/// Turns nodes `first` to `last` around the strand that passes the upper knot: not at all at the first, by the full
/// angle from `full` on.
Points wound(const Centreline& line, Eigen::Index first, Eigen::Index full, double angle) {
  Points points = line.points;
  const Vec3 strand = points.col(node_at(line, line.knots[1].threaded));
  for (Eigen::Index i = first; i < points.cols(); ++i) {
    const double share = std::min(1.0, static_cast<double>(i - first) / static_cast<double>(full - first));
    const Vec3 hub(strand.x(), strand.y(), points(2, i));
    points.col(i) = hub + Eigen::AngleAxisd(angle * share, Vec3::UnitZ()) * (points.col(i) - hub);
  }
  return points;
}

TEST_P(K7_Loop, KeepsItWhileATailWindsAroundTheOtherStrand) {
  FishermanShape shape;
  shape.handedness = GetParam();
  shape.tail = 0.1;
  const Centreline line = fisherman_loop(shape);
  const Eigen::Index exit = node_at(line, line.knots[1].tail_exit);
  for (const double sense : {-1.0, 1.0}) {
    LoopTopology topology = topology_of(line, shape.radius);
    for (double angle = 0.0; angle < 4.0 * M_PI; angle += 0.2) {
      expect_fisherman(topology.read(wound(line, exit, exit + 20, sense * angle), Vec3::UnitZ()), GetParam());
    }
  }
}

TEST_P(K7_Loop, KeepsItWhileAWholeKnotTurnsAroundTheOtherStrand) {
  FishermanShape shape;
  shape.handedness = GetParam();
  shape.knot_distance = 0.15;
  const Centreline line = fisherman_loop(shape);
  const Eigen::Index full = node_at(line, line.knots[1].standing_begin);
  const Eigen::Index first = full - 25;
  for (const double sense : {-1.0, 1.0}) {
    LoopTopology topology = topology_of(line, shape.radius);
    for (double angle = 0.0; angle < 4.0 * M_PI; angle += 0.5) {
      expect_fisherman(topology.read(wound(line, first, full, sense * angle), Vec3::UnitZ()), GetParam());
    }
  }
}

/// As the pair of knots wanders to a roller, the standing part of one goes around it, and its node lies on the far
/// side.
TEST_P(K7_Loop, KeepsItWhereTheStandingPartHasGoneAroundTheRoller) {
  FishermanShape shape;
  shape.handedness = GetParam();
  const Centreline line = fisherman_loop(shape);
  const Eigen::Index lower = node_at(line, line.knots[0].standing_begin);
  for (const double beyond : {0.0, 0.03, 0.08}) {
    LoopTopology topology(lower, node_at(line, line.lower_apex - beyond), shape.radius);
    expect_fisherman(topology.read(line.points, Vec3::UnitZ()), GetParam());
  }
}

TEST_P(K7_Loop, KeepsItWhereAKnotTurnedFurtherThanCouldBeFollowed) {
  FishermanShape shape;
  shape.handedness = GetParam();
  shape.knot_distance = 0.15;
  const Centreline line = fisherman_loop(shape);
  const Eigen::Index full = node_at(line, line.knots[1].standing_begin);
  LoopTopology topology = topology_of(line, shape.radius);
  const LoopTopology::Reading tied = topology.read(line.points, Vec3::UnitZ());
  const Points turned = wound(line, full - 25, full, 2.0 * M_PI);
  EXPECT_FALSE(LoopTopology(topology).read(turned, Vec3::UnitZ()).same_knot(tied));
  expect_fisherman(topology.read_as(tied, turned, Vec3::UnitZ()), GetParam());
  expect_fisherman(topology.read(turned, Vec3::UnitZ()), GetParam());
}

TEST_P(K7_Loop, LosesItWhenATailLeavesItsCoil) {
  FishermanShape shape;
  shape.handedness = GetParam();
  const Centreline line = fisherman_loop(shape);
  LoopTopology topology = topology_of(line, shape.radius);
  const LoopTopology::Reading tied = topology.read(line.points, Vec3::UnitZ());
  // The tail pulled back into the coil, and out of it sideways.
  Points points = line.points;
  const Eigen::Index middle = node_at(line, line.knots[1].coil_middle);
  const Vec3 from = points.col(middle);
  for (Eigen::Index i = middle + 1; i < points.cols(); ++i) {
    const double along = static_cast<double>(i - middle) * (line.points.col(1) - line.points.col(0)).norm();
    points.col(i) = from + along * (from - points.col(node_at(line, line.knots[1].threaded))).normalized();
  }
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
