#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "knot_utm/contact/closest_points.hpp"
#include "knot_utm/contact/tunnelling.hpp"

namespace knot_utm {
namespace {

// ---- the oracle: long double, the exact cubic and a fine sampling in time ---------------------------------------

using Real = long double;
using Vec = Eigen::Matrix<Real, 3, 1>;

/// g_00, a, b at a time.
struct Gaps {
  Vec p, a, b;
};

struct Motion {
  EdgePair start, end;

  Gaps at(Real tau) const {
    auto gaps = [](const EdgePair& e) -> Gaps {
      const Vec a0 = e.a0.cast<Real>(), a1 = e.a1.cast<Real>(), b0 = e.b0.cast<Real>(), b1 = e.b1.cast<Real>();
      return {a0 - b0, a1 - a0, b1 - b0};
    };
    const Gaps s = gaps(start), e = gaps(end);
    return {s.p + tau * (e.p - s.p), s.a + tau * (e.a - s.a), s.b + tau * (e.b - s.b)};
  }
  double extent() const {
    Real sum = 0.0;
    for (const Real tau : {0.0L, 1.0L}) sum += at(tau).p.norm() + at(tau).a.norm() + at(tau).b.norm();
    return static_cast<double>(sum);
  }
};

/// From a point to q + u b, 0 <= u <= 1.
Real to_edge(const Vec& point, const Vec& q, const Vec& b) {
  const Real bb = b.squaredNorm();
  const Real u = bb > 0.0L ? std::clamp(b.dot(point - q) / bb, 0.0L, 1.0L) : 0.0L;
  return (q + u * b - point).norm();
}

Real distance(const Gaps& g) {
  const Vec origin = Vec::Zero();
  Real best = std::min(
      {to_edge(g.p, origin, g.b), to_edge(g.p + g.a, origin, g.b), to_edge(origin, g.p, g.a), to_edge(g.b, g.p, g.a)});
  const Vec n = g.a.cross(g.b);
  const Real nn = n.squaredNorm();
  if (nn > 1e-30L * g.a.squaredNorm() * g.b.squaredNorm()) {
    // p + t a - u b is along n.
    const Real t = -g.p.cross(g.b).dot(n) / nn, u = -g.p.cross(g.a).dot(n) / nn;
    if (t >= 0.0L && t <= 1.0L && u >= 0.0L && u <= 1.0L) best = std::min(best, (g.p + t * g.a - u * g.b).norm());
  }
  return best;
}

/// Times at which the four ends lie in a plane: roots of the cubic det(p, a, b) in [0, 1], between its turning points.
std::vector<Real> coplanar_times(const Motion& motion) {
  auto f = [&](Real tau) {
    const Gaps g = motion.at(tau);
    return g.p.dot(g.a.cross(g.b));
  };
  // The cubic's coefficients from four of its values.
  const Real f0 = f(0.0L), f1 = f(1.0L), fm = f(-1.0L), f2 = f(2.0L);
  const Real c2 = 0.5L * (f1 + fm) - f0, odd = 0.5L * (f1 - fm);
  const Real c3 = (f2 - f0 - 4.0L * c2 - 2.0L * odd) / 6.0L, c1 = odd - c3;
  std::vector<Real> turns{0.0L, 1.0L};
  auto add = [&](Real tau) {
    if (tau > 0.0L && tau < 1.0L) turns.push_back(tau);
  };
  const Real discriminant = c2 * c2 - 3.0L * c1 * c3;
  if (discriminant > 0.0L && c3 != 0.0L) {
    add((-c2 - std::sqrt(discriminant)) / (3.0L * c3));
    add((-c2 + std::sqrt(discriminant)) / (3.0L * c3));
  }
  if (c2 != 0.0L) add(-0.5L * c1 / c2);
  std::sort(turns.begin(), turns.end());
  std::vector<Real> roots = turns;  // where it only touches zero
  for (std::size_t i = 1; i < turns.size(); ++i) {
    Real low = turns[i - 1], high = turns[i];
    if ((f(low) < 0.0L) == (f(high) < 0.0L)) continue;
    for (int k = 0; k < 80; ++k)
      ((f(0.5L * (low + high)) < 0.0L) == (f(low) < 0.0L) ? low : high) = 0.5L * (low + high);
    roots.push_back(0.5L * (low + high));
  }
  return roots;
}

/// Least distance over the whole motion.
double least_distance(const Motion& motion) {
  constexpr int kSamples = 60;
  auto d = [&](Real tau) { return distance(motion.at(tau)); };
  Real best = std::numeric_limits<Real>::infinity();
  for (const Real tau : coplanar_times(motion)) best = std::min(best, d(tau));
  std::vector<Real> sampled;
  for (int i = 0; i <= kSamples; ++i) sampled.push_back(d(static_cast<Real>(i) / kSamples));
  for (int i = 0; i <= kSamples; ++i) {
    const auto k = static_cast<std::size_t>(i);
    best = std::min(best, sampled[k]);
    if ((i > 0 && sampled[k - 1] < sampled[k]) || (i < kSamples && sampled[k + 1] < sampled[k])) continue;
    Real low = static_cast<Real>(std::max(i - 1, 0)) / kSamples,
         high = static_cast<Real>(std::min(i + 1, kSamples)) / kSamples;
    for (int n = 0; n < 60; ++n) {
      const Real a = low + (high - low) / 3.0L, b = high - (high - low) / 3.0L;
      if (d(a) < d(b))
        high = b;
      else
        low = a;
    }
    best = std::min(best, d(low));
  }
  return static_cast<double>(best);
}

// ---- families of pairs ------------------------------------------------------------------------------------------

class Pairs {
 public:
  Motion generic() { return {{any(), any(), any(), any()}, {any(), any(), any(), any()}}; }

  /// Small whole numbers: parallel, coplanar, collinear, touching, of no length, at rest.
  Motion lattice(int size) {
    std::uniform_int_distribution<int> whole(-size, size);
    auto point = [&] { return Vec3(whole(random_), whole(random_), whole(random_)); };
    return {{point(), point(), point(), point()}, {point(), point(), point(), point()}};
  }
  Motion plane() {
    Motion out = generic();
    for (EdgePair* edges : {&out.start, &out.end})
      for (Vec3* point : {&edges->a0, &edges->a1, &edges->b0, &edges->b1}) point->z() = 0.0;
    return out;
  }
  Motion at_rest() {
    const EdgePair pair = generic().start;
    return {pair, pair};
  }
  /// Parallel all the time, going past or through each other.
  Motion parallel() {
    const Vec3 edge = any();
    auto pair = [&]() -> EdgePair {
      const Vec3 a = any(), b = a + share() * edge + 0.3 * share() * any();
      return {a, a + edge, b, b + edge};
    };
    return {pair(), pair()};
  }
  /// Neighbours of a straight rod: in line all the time, end to end or with a gap.
  Motion in_line() {
    const Vec3 along = any();
    auto pair = [&](double gap) -> EdgePair { return {Vec3::Zero(), along, (1.0 + gap) * along, (2.0 + gap) * along}; };
    std::uniform_int_distribution<int> whole(0, 3);
    return {pair(0.5 * whole(random_)), pair(0.5 * whole(random_))};
  }
  /// One thrown across the other: through it, or past its end by `gap` times its length.
  Motion thrown(double gap) {
    const Vec3 b0 = any(), b = any(), a = any(), way = any();
    const double on_b = gap > 0.0 ? 1.0 + gap : std::abs(share()), on_a = std::abs(share()), when = std::abs(share());
    const Vec3 meet = b0 + on_b * b;
    const Vec3 from = meet - on_a * a - when * way;
    return {{from, from + a, b0, b0 + b}, {from + way, from + way + a, b0, b0 + b}};
  }
  /// Two that turn together as one body, near to each other all the time.
  Motion rolling(double gap) {
    const Mat3 frame = Eigen::AngleAxisd(M_PI * share(), any().normalized()).toRotationMatrix();
    const Mat3 turn = Eigen::AngleAxisd(share(), any().normalized()).toRotationMatrix();
    const EdgePair pair{frame * Vec3(-0.5, 0, gap), frame * Vec3(0.5, 0, gap), frame * Vec3(0, -0.5, 0),
                        frame * Vec3(0, 0.5, 0)};
    return {pair, {turn * pair.a0, turn * pair.a1, turn * pair.b0, turn * pair.b1}};
  }

 private:
  double share() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random_); }
  Vec3 any() {
    const double x = share(), y = share();
    return {x, y, share()};
  }

  std::mt19937 random_{7};
};

struct Count {
  int met = 0, apart = 0;
};

/// Holds `trials` motions of a family against the oracle, each at a scale and place of its own.
Count hold(int trials, const std::function<Motion()>& next) {
  constexpr double kZero = 1e-11;    // what the oracle's least distance is good to
  constexpr double kMeeting = 1e-6;  // as the header promises; both of the extent
  Count count;
  for (int i = 0; i < trials; ++i) {
    Motion motion = next();
    const double scale = i % 3 == 0 ? 1e-3 : i % 3 == 1 ? 1.0 : 30.0;
    const Vec3 offset = i % 2 == 0 ? Vec3::Zero() : Vec3(0.3, -0.1, 0.7);
    for (EdgePair* edges : {&motion.start, &motion.end})
      for (Vec3* point : {&edges->a0, &edges->a1, &edges->b0, &edges->b1}) *point = scale * *point + offset;
    const double least = least_distance(motion), extent = motion.extent();
    const bool met = meeting(motion.start, motion.end).has_value();
    if (least <= kZero * extent) {
      EXPECT_TRUE(met) << "passage missed, motion " << i;
    }
    if (met) {
      EXPECT_LE(least, (1.0 + 1e-6) * kMeeting * extent) << "false alarm, motion " << i;
    }
    ++(met ? count.met : count.apart);
  }
  return count;
}

TEST(MovingEdges, AreThoseOfTheOracleInEveryFamily) {
  Pairs pairs;
  struct Family {
    const char* name;
    int trials, least_met, least_apart;
    std::function<Motion()> next;
  };
  const Family families[] = {
      {"generic", 700, 40, 150, [&] { return pairs.generic(); }},
      {"lattice of 3", 1000, 300, 150, [&] { return pairs.lattice(1); }},
      {"lattice of 5", 700, 70, 150, [&] { return pairs.lattice(2); }},
      {"in a plane", 300, 80, 25, [&] { return pairs.plane(); }},
      {"at rest", 150, 0, 150, [&] { return pairs.at_rest(); }},
      {"parallel", 300, 0, 140, [&] { return pairs.parallel(); }},
      {"in line", 150, 25, 25, [&] { return pairs.in_line(); }},
      {"thrown through", 400, 400, 0, [&] { return pairs.thrown(0.0); }},
      {"thrown past the end by a thousandth", 200, 0, 175, [&] { return pairs.thrown(1e-3); }},
      {"rolling, a hundredth apart", 200, 0, 30, [&] { return pairs.rolling(1e-2); }},
      {"rolling, a ten-thousandth apart", 200, 0, 10, [&] { return pairs.rolling(1e-4); }},
  };
  for (const Family& family : families) {
    SCOPED_TRACE(family.name);
    const Count count = hold(family.trials, family.next);
    EXPECT_GE(count.met, family.least_met);
    EXPECT_GE(count.apart, family.least_apart);
  }
}

TEST(MovingEdges, MeetWhereAndWhileTheyCross) {
  const EdgePair above{{-1, 0, 1}, {3, 0, 1}, {0, -1, 0}, {0, 3, 0}},
      below{{-1, 0, -1}, {3, 0, -1}, above.b0, above.b1};
  const auto at = meeting(above, below);
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->on_a, 0.25, 1e-12);
  EXPECT_NEAR(at->on_b, 0.25, 1e-12);
  EXPECT_FALSE(meeting(above, above));
  EXPECT_FALSE(meeting(below, below));
}

TEST(MovingEdges, WhatIsNotANumberMeets) {
  const EdgePair pair{{0, 0, 1}, {1, 0, 1}, {0, 0, 0}, {0, 1, 0}};
  for (Vec3 EdgePair::*point : {&EdgePair::a0, &EdgePair::a1, &EdgePair::b0, &EdgePair::b1}) {
    EdgePair lost = pair;
    (lost.*point).y() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(meeting(pair, lost));
    EXPECT_TRUE(meeting(lost, pair));
  }
}

// ---- closest points of two segments -----------------------------------------------------------------------------

struct Segments {
  Vec3 p, a, q, b;
  double objective(double t, double u, double r) const {
    return 0.5 * (p + t * a - q - u * b).squaredNorm() + 0.5 * r * ((t - 0.5) * (t - 0.5) + (u - 0.5) * (u - 0.5));
  }
};

/// Smallest objective over a grid that closes in on its best point; convex, so the best point is not lost.
double brute_force(const Segments& pair, double r) {
  constexpr int kGrid = 20;
  double low_t = 0.0, high_t = 1.0, low_u = 0.0, high_u = 1.0, best = 1e300;
  for (int round = 0; round < 14; ++round) {
    double best_t = 0.0, best_u = 0.0;
    best = 1e300;
    for (int i = 0; i <= kGrid; ++i)
      for (int j = 0; j <= kGrid; ++j) {
        const double t = low_t + (high_t - low_t) * i / kGrid, u = low_u + (high_u - low_u) * j / kGrid;
        const double value = pair.objective(t, u, r);
        if (value < best) best = value, best_t = t, best_u = u;
      }
    // A narrow oblique valley may run past the neighbouring grid points: keep half of the range.
    const double dt = 0.25 * (high_t - low_t), du = 0.25 * (high_u - low_u);
    low_t = std::max(0.0, best_t - dt), high_t = std::min(1.0, best_t + dt);
    low_u = std::max(0.0, best_u - du), high_u = std::min(1.0, best_u + du);
  }
  return best;
}

TEST(ClosestPoints, AreThoseThatBruteForceFinds) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  auto vector = [&] { return Vec3(place(random), place(random), place(random)); };
  int inside = 0, at_end = 0, at_both_ends = 0;
  for (int i = 0; i < 400; ++i) {
    Segments pair{vector(), vector(), vector(), vector()};
    if (i % 4 == 0) pair.b = place(random) * pair.a;                // parallel
    if (i % 4 == 1) pair.b = pair.a + 0.01 * vector();              // nearly so
    if (i % 8 == 2) pair.q = pair.p + 0.5 * pair.a - 0.5 * pair.b;  // crossing
    for (const double r : {0.0, 0.01}) {
      const ClosestPoints at = closest_points(pair.p, pair.a, pair.q, pair.b, r);
      EXPECT_GE(at.t, 0.0);
      EXPECT_LE(at.t, 1.0);
      EXPECT_GE(at.u, 0.0);
      EXPECT_LE(at.u, 1.0);
      EXPECT_LE(pair.objective(at.t, at.u, r), brute_force(pair, r) + 1e-12) << "pair " << i << ", r = " << r;
      if (r > 0.0) ++(at.t_free && at.u_free ? inside : at.t_free || at.u_free ? at_end : at_both_ends);
    }
  }
  EXPECT_GT(inside, 20);
  EXPECT_GT(at_end, 20);
  EXPECT_GT(at_both_ends, 20);
}

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
