#include "knot_utm/contact/foot_sieve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>

#include "knot_utm/contact/centreline_curve.hpp"

namespace knot_utm {
namespace {

constexpr int kNodes = 60;

/// Does F'(u) = -(a - c).c' go from below zero to above between two of many places of the segment?
bool has_foot(const Points& nodes, int segment, const Vec3& a) {
  constexpr int kPlaces = 300;
  bool below = false;
  for (int i = 0; i <= kPlaces; ++i) {
    const SegmentWeights w(static_cast<double>(i) / kPlaces);
    const double slope = -(a - combine(w.value, nodes, segment)).dot(combine(w.derivative, nodes, segment));
    if (below && slope >= 0.0) return true;
    below = slope < 0.0;
  }
  return false;
}

/// Points looked at with all segments as candidates, in runs that begin and end anywhere.
struct Look {
  int feet = 0, left = 0, lost = 0;
  bool in_order = true;

  Look(const Points& nodes, std::mt19937& random) {
    const Eigen::Index edges = nodes.cols() - 1;
    const Candidates::Run runs[] = {{1, 1}, {2, 9}, {10, 12}, {13, 40}, {41, static_cast<int>(edges) - 1}};
    FootSieve sieve(nodes.cols());
    sieve.set_centreline(nodes);
    std::uniform_int_distribution<Eigen::Index> some(0, edges);
    std::normal_distribution<double> away(0.0, 1.0);
    for (int look = 0; look < 100; ++look) {
      Vec3 a[2];
      for (Vec3& point : a) point = nodes.col(some(random)) + Vec3(away(random), away(random), away(random));
      sieve.sieve(to_lanes(a[0]), to_lanes(a[1]), std::begin(runs), std::end(runs));
      for (int p = 0; p < 2; ++p) {
        in_order = in_order && std::is_sorted(sieve.begin(p), sieve.end(p));
        left += static_cast<int>(sieve.end(p) - sieve.begin(p));
        for (int segment = 1; segment < edges; ++segment) {
          if (!has_foot(nodes, segment, a[p])) continue;
          ++feet;
          lost += std::find(sieve.begin(p), sieve.end(p), segment) == sieve.end(p);
        }
      }
    }
  }
};

TEST(FootSieve, LosesNoFootThatBruteForceFindsHoweverTheRodIsBent) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-2.0, 2.0);
  for (int scene = 0; scene < 10; ++scene) {
    Points nodes(3, kNodes);
    for (Eigen::Index i = 0; i < nodes.size(); ++i) nodes.data()[i] = place(random);
    const Look look(nodes, random);
    EXPECT_GT(look.feet, 1000);
    EXPECT_EQ(look.lost, 0);
    EXPECT_TRUE(look.in_order);
  }
}

TEST(FootSieve, LeavesLittleElseOfAKnottedRod) {
  // A trefoil bent as sharply as tight knots are, with edges that differ by half.
  Points nodes(3, kNodes);
  for (int i = 0; i < kNodes; ++i) {
    const double turn = 2.0 * M_PI * (i + 0.7 * std::sin(0.5 * i)) / kNodes;
    nodes.col(i) << std::sin(turn) + 2.0 * std::sin(2.0 * turn), std::cos(turn) - 2.0 * std::cos(2.0 * turn),
        -std::sin(3.0 * turn);
  }
  std::mt19937 random(8);
  const Look look(nodes, random);
  EXPECT_GT(look.feet, 200);
  EXPECT_EQ(look.lost, 0);
  EXPECT_LT(look.left, 1.5 * look.feet);
}

}  // namespace
}  // namespace knot_utm
