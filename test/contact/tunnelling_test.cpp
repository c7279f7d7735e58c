#include "knot_utm/contact/tunnelling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace knot_utm {
namespace {

std::vector<std::pair<int, int>> all_that_meet(const Points& start, const Points& end) {
  std::vector<std::pair<int, int>> out;
  const int edges = static_cast<int>(start.cols()) - 1;
  auto pair = [](const Points& x, int a, int b) -> EdgePair {
    return {x.col(a), x.col(a + 1), x.col(b), x.col(b + 1)};
  };
  for (int a = 0; a < edges; ++a)
    for (int b = a + 2; b < edges; ++b)
      if (meeting(pair(start, a, b), pair(end, a, b))) out.push_back({a, b});
  return out;
}

std::optional<Tunnelling> passage(const Points& start, const Points& end) {
  return TunnellingSearch(start.cols()).find(start, end);
}

class Rods {
 public:
  /// Edges of length one; each turns from the one before by `sharpness` or so [rad].
  Points any(int nodes, double sharpness) {
    Points x = Points::Zero(3, nodes);
    Vec3 edge = direction();
    for (int i = 1; i < nodes; ++i) {
      edge = (edge + sharpness * direction()).normalized();
      x.col(i) = Vec3(x.col(i - 1)) + edge;
    }
    return x;
  }
  /// Every node by `far` or so on its own, and by as much all together.
  Points moved(const Points& x, double far) {
    Points out = x;
    const Vec3 together = direction();
    for (Eigen::Index i = 0; i < x.cols(); ++i) out.col(i) += far * (direction() + together);
    return out;
  }

 private:
  Vec3 direction() {
    const double x = normal_(random_), y = normal_(random_);
    return Vec3(x, y, normal_(random_)).normalized();
  }
  std::mt19937 random_{11};
  std::normal_distribution<double> normal_;
};

TEST(TunnellingSearch, IsFoundWhereAllPairsOfEdgesHaveOne) {
  Rods rods;
  int passed = 0, kept = 0;
  for (const int nodes : {3, 4, 5, 8, 17, 40, 65})
    for (const double sharpness : {0.1, 0.4, 1.0, 3.0})
      for (const double far : {0.0, 0.02, 0.1, 0.3, 1.0, 5.0})
        for (int trial = 0; trial < 10; ++trial) {
          const Points start = rods.any(nodes, sharpness), end = rods.moved(start, far);
          const auto expected = all_that_meet(start, end);
          const auto found = passage(start, end);
          ASSERT_EQ(found.has_value(), !expected.empty()) << nodes << ' ' << sharpness << ' ' << far;
          ++(found ? passed : kept);
          if (found) {
            EXPECT_EQ(std::count(expected.begin(), expected.end(), std::pair{found->edge_a, found->edge_b}), 1);
          }
        }
  EXPECT_GT(passed, 200);
  EXPECT_GT(kept, 500);
}

TEST(TunnellingSearch, EndsThatSlipOverAStrandPassNothing) {
  // A hook: a strand along x, and the rod's tail across it at height one, which is drawn back along y over the strand.
  auto hook = [](double tail) {
    Points x(3, 8);
    for (int i = 0; i < 5; ++i) x.col(i) << 2.0 * i, 0.0, 0.0;
    x.col(5) << 10.0, 4.0, 1.0;
    x.col(6) << 4.3, 5.0 + tail, 1.0;
    x.col(7) << 4.3, tail, 1.0;
    return x;
  };
  EXPECT_FALSE(passage(hook(-1.0), hook(3.0)));
  Points dropped = hook(3.0);
  dropped.col(7).z() = -1.0;
  EXPECT_FALSE(passage(hook(3.0), dropped)) << "beside the strand";
  EXPECT_FALSE(passage(hook(-1.0), dropped)) << "off the strand before it is down";
  Points through = hook(-1.0);
  through.col(7).z() = -1.0;
  EXPECT_TRUE(passage(hook(-1.0), through));
}

/// A strand along x, a wide detour, and the rod's tail: a last edge of length two along y, which lies across the strand
/// at height one or minus one. `across`: the share of that edge, from its inner node, that lies over the strand.
Points tail_across(double across, double height) {
  Points x(3, 8);
  for (int i = 0; i < 5; ++i) x.col(i) << 2.0 * i, 0.0, 0.0;
  x.col(5) << 10.0, 10.0, 3.0;
  x.col(6) << 4.3, 2.0 * across, height;
  x.col(7) << 4.3, 2.0 * across - 2.0, height;
  return x;
}

TEST(TunnellingSearch, OverTheOuterHalfOfAnEndEdgeCountsOnlyWhereTheEndsAreNotBare) {
  for (const bool from_the_other_end : {false, true})
    for (const double across : {0.05, 0.45, 0.55, 0.95}) {
      Points start = tail_across(across, 1.0), end = tail_across(across, -1.0);
      if (from_the_other_end) {
        start = start.rowwise().reverse().eval();
        end = end.rowwise().reverse().eval();
      }
      const bool inner = across < 0.5;
      EXPECT_TRUE(TunnellingSearch(8).find(start, end)) << across;
      EXPECT_EQ(TunnellingSearch(8, true).find(start, end).has_value(), inner) << across;
    }
}

TEST(TunnellingSearch, EndsOfRopesAtACutAreBareAsThoseOfTheRodAre) {
  for (const bool from_the_other_end : {false, true})
    for (const double across : {0.05, 0.45, 0.55, 0.95}) {
      Points start(3, 11), end(3, 11);
      start << tail_across(across, 1.0), Vec3(0, 0, 50), Vec3(1, 0, 50), Vec3(2, 0, 50);
      end << tail_across(across, -1.0), Vec3(0, 0, 50), Vec3(1, 0, 50), Vec3(2, 0, 50);
      if (from_the_other_end) {
        start = start.rowwise().reverse().eval();
        end = end.rowwise().reverse().eval();
      }
      TunnellingSearch search(11, true);
      search.part(from_the_other_end ? 2 : 7);
      EXPECT_EQ(search.find(start, end).has_value(), across < 0.5) << across;
    }
}

TEST(TunnellingSearch, OverABareEndFirstAndThenOverTheInnerHalfCounts) {
  // The tail goes along the strand while that tilts from one side to the other: the strand sinks through the tail's
  // outer half after a quarter of the time, and rises through its inner half after three quarters.
  const auto at = [](double time) {
    Points x = tail_across(0.9 - 0.8 * time, 0.2);
    x.col(2).z() = 1.0 - 2.0 * time;
    x.col(3).z() = 2.0 * time - 1.0;
    x.col(6).x() = x.col(7).x() = 4.2 + 1.6 * time;
    return x;
  };
  const auto found = TunnellingSearch(8, true).find(at(0.0), at(1.0));
  ASSERT_TRUE(found);
  EXPECT_EQ(std::pair(found->edge_a, found->edge_b), std::pair(2, 6));
  EXPECT_NEAR(found->on_b, 0.3, 1e-3);
  EXPECT_FALSE(TunnellingSearch(8, true).find(at(0.0), at(0.5))) << "over the outer half alone";
}

}  // namespace
}  // namespace knot_utm
