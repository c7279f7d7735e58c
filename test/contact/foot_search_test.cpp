#include "knot_utm/contact/foot_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace knot_utm {
namespace {

constexpr int kNodes = 40;

struct Place {
  int segment;
  double u, d;
};

/// F'(u) = -(a - c).c'
double slope(const Points& nodes, int segment, const Vec3& a, double u) {
  const SegmentWeights w(u);
  return -(a - combine(w.value, nodes, segment)).dot(combine(w.derivative, nodes, segment));
}

/// Where F' rises through zero between two of many places, then by bisection.
std::vector<Place> feet_by_bisection(const Points& nodes, const Vec3& a, double reach) {
  constexpr int kPlaces = 400;
  std::vector<Place> out;
  for (int segment = 1; segment + 1 < nodes.cols(); ++segment)
    for (int i = 0; i < kPlaces; ++i) {
      double low = static_cast<double>(i) / kPlaces, high = static_cast<double>(i + 1) / kPlaces;
      if (!(slope(nodes, segment, a, low) < 0.0 && slope(nodes, segment, a, high) >= 0.0)) continue;
      for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        (slope(nodes, segment, a, middle) < 0.0 ? low : high) = middle;
      }
      const double d = (a - combine(SegmentWeights(high).value, nodes, segment)).norm();
      if (d < reach) out.push_back({segment, high, d});
    }
  return out;
}

TEST(FootSearch, FindsTheFeetThatBisectionFindsWhateverTheShape) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-2.0, 2.0);
  std::uniform_int_distribution<Eigen::Index> some(0, kNodes - 1);
  std::vector<int> segments(kNodes - 2);
  std::iota(segments.begin(), segments.end(), 1);
  const Candidates::Run all[] = {{1, kNodes - 2}};
  constexpr double kReach = 1.5;
  FootSearch search(kNodes, kReach);
  int feet = 0, twice = 0;
  for (int scene = 0; scene < 20; ++scene) {
    Points nodes(3, kNodes);
    for (Eigen::Index i = 0; i < nodes.size(); ++i) nodes.data()[i] = place(random);
    search.begin(nodes, segments);
    std::vector<Vec3> points;
    std::vector<int> numbers;
    for (int look = 0; look < 15; ++look) {
      for (int p = 0; p < 2; ++p) {
        points.push_back(nodes.col(some(random)) + 0.3 * Vec3(place(random), place(random), place(random)));
        numbers.push_back(2 * look + p);
      }
      search.look(to_lanes(points[points.size() - 2]), to_lanes(points.back()), std::begin(all), std::end(all));
    }
    search.find();
    auto found = search.feet().begin();
    for (std::size_t p = 0; p < points.size(); ++p) {
      int last_segment = 0;
      for (const Place& foot : feet_by_bisection(nodes, points[p], kReach)) {
        ASSERT_NE(found, search.feet().end());
        EXPECT_EQ(found->point, numbers[p]);
        EXPECT_EQ(found->segment, foot.segment);
        // Halley's last step leaves its cube; where F' hardly rises, a foot is ill defined but its distance is not.
        EXPECT_NEAR(found->x[3], foot.d, 1e-12);
        EXPECT_NEAR(to_vec3(found->x).norm(), foot.d, 1e-12);
        EXPECT_NEAR(found->u, foot.u, 1e-6);
        twice += foot.segment == last_segment;
        last_segment = foot.segment;
        ++feet;
        ++found;
      }
    }
    EXPECT_EQ(found, search.feet().end());
  }
  EXPECT_GT(feet, 1000);
  EXPECT_GT(twice, 0);
}

/// A rod that is wound around another one, whose nodes are moved a little.
class FollowedFeet : public testing::Test {
 protected:
  static constexpr double kReach = 1.5;

  FollowedFeet() : segments_(kNodes - 2), search_(kNodes, kReach) {
    std::iota(segments_.begin(), segments_.end(), 1);
    for (int i = 0; i < kNodes; ++i) nodes_.col(i) = Vec3(std::cos(0.4 * i), std::sin(0.4 * i), 0.08 * i);
  }

  void find() {
    search_.begin(nodes_, segments_);
    for (const Vec3& point : points()) search_.look(to_lanes(point), to_lanes(point), std::begin(all_), std::end(all_));
    search_.find();
  }

  bool follow() {
    search_.begin_to_follow(nodes_, segments_);
    for (const Vec3& point : points()) search_.add(to_lanes(point), to_lanes(point));
    return search_.follow();
  }

  /// Everything moves by `most` times numbers between -1 and 1.
  void move(double most) {
    std::uniform_real_distribution<double> by(-most, most);
    for (Eigen::Index i = 0; i < nodes_.size(); ++i) nodes_.data()[i] += by(random_);
    axis_ += Vec3(by(random_), by(random_), by(random_));
  }

  /// Places of the strand that the rod is wound around.
  std::vector<Vec3> points() const {
    std::vector<Vec3> out;
    for (double z = 0.1; z < 3.0; z += 0.05) out.push_back(axis_ + Vec3(0.3, 0.1, z));
    return out;
  }

  std::mt19937 random_{5};
  Points nodes_{3, kNodes};
  Vec3 axis_ = Vec3::Zero();
  std::vector<int> segments_;
  const Candidates::Run all_[1] = {{1, kNodes - 2}};
  FootSearch search_;
};

/// As the nodes move at random, feet of a search come and go; those that were there must be found again.
TEST_F(FollowedFeet, AreThoseOfASearch) {
  find();
  ASSERT_GT(search_.feet().size(), 50u);
  move(1e-4);
  ASSERT_TRUE(follow());
  const std::vector<FootSearch::Foot> followed = search_.feet();
  find();
  for (const FootSearch::Foot& foot : followed) {
    bool found = false;
    for (const FootSearch::Foot& other : search_.feet())
      // A search ends with a step whose cube is below rounding.
      found |= other.point == foot.point && other.segment == foot.segment && std::abs(other.u - foot.u) < 1e-12 &&
               (to_vec3(other.x) - to_vec3(foot.x)).norm() < 1e-12;
    EXPECT_TRUE(found) << "point " << foot.point;
  }
}

TEST_F(FollowedFeet, AreLostWhereTheyLeaveTheirSegments) {
  find();
  for (int i = 0; i < kNodes; ++i) nodes_.col(i) = Vec3(std::cos(0.4 * i + 1.0), std::sin(0.4 * i + 1.0), 0.08 * i);
  EXPECT_FALSE(follow());
}

}  // namespace
}  // namespace knot_utm
