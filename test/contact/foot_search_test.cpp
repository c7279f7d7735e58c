#include "knot_utm/contact/foot_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <random>
#include <vector>

#include "contact/strands.hpp"
#include "knot_utm/contact/smooth_contact.hpp"
#include "knot_utm/numeric/archive.hpp"

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

constexpr double kFar = -1.0;  // overlap of strands so far apart that no foot is followed
constexpr double kStep = 0.01;

/// Two straight strands beside each other, the second one as near as wanted.
class Beside {
 public:
  explicit Beside(std::size_t edges = 30)
      : strands_(straight_strand(Vec3::Zero(), Vec3::UnitZ(), std::vector(edges, 0.6)),
                 straight_strand(Vec3(2.0, 0.0, 0.0), Vec3::UnitZ(), std::vector(edges, 0.6))),
        contact_(strands_.rod, NormalLaw{1.0, 0.01}, Friction(), 0.5),
        accepted_(at(kFar)) {}

  /// One iterate of a step: how many points in the middle of the strands press, of all that they have there.
  double pressing(double overlap) {
    contact_.evaluate(at(overlap), accepted_, kStep);
    const auto pressing =
        std::count_if(contact_.contacts().begin(), contact_.contacts().end(), [&](const ContactPoint& point) {
          const bool in_middle = std::any_of(std::begin(kMiddle), std::end(kMiddle),
                                             [&](int i) { return point.a0 == i || point.a0 == strands_.second + i; });
          return in_middle && point.force.norm() > 0.0;
        });
    return static_cast<double>(pressing) / (4.0 * static_cast<double>(std::size(kMiddle)));  // two a segment and strand
  }
  /// As if a bend closed around the points: the strands overlap, and no foot has been followed yet.
  void close(double overlap) { accepted_ = at(overlap); }
  void begin() { contact_.begin(accepted_); }
  void commit(double overlap) {
    accepted_ = at(overlap);
    contact_.commit(accepted_);
  }
  /// A whole step, which ends there.
  double step_to(double overlap) {
    begin();
    const double out = pressing(overlap);
    commit(overlap);
    return out;
  }

  /// From now on friction acts at the surfaces.
  void act_at_surface() { contact_.act_at_surface(1.0, turns_); }
  /// Weighting factor of a contact in the middle of the strands, in the last iterate.
  double weighting() const {
    const auto in_middle = [](const ContactPoint& point) { return point.a0 == kMiddle[2]; };
    return std::find_if(contact_.contacts().begin(), contact_.contacts().end(), in_middle)->weighting;
  }

  std::string saved() {
    Archive archive("contact");
    archive(contact_);
    return archive.bytes();
  }
  void load(const std::string& bytes, double overlap) {
    Archive archive("contact", bytes, "here");
    archive(contact_);
    archive.end();
    accepted_ = at(overlap);
  }

 private:
  static constexpr int kMiddle[] = {12, 13, 14, 15, 16};  // first nodes of segments

  Points at(double overlap) const { return strands_.moved(Vec3(-overlap, 0.0, 0.0)); }

  SectionTurns turns_;
  TwoStrandsOfARod strands_;
  SmoothContact contact_;
  Points accepted_;
};

TEST(DeepFoot, PressesWhereTheRodIsDrawnSoDeep) {
  Beside strands;
  EXPECT_EQ(strands.step_to(1.0), 1.0) << "nothing can have closed around it before the first step";
  EXPECT_EQ(strands.step_to(1.0), 1.0);
}

TEST(DeepFoot, TakesNoPartWhereItAppears) {
  Beside strands;
  EXPECT_EQ(strands.step_to(kFar), 0.0);
  strands.close(0.9);
  EXPECT_EQ(strands.step_to(1.0), 0.0);
  EXPECT_EQ(strands.step_to(0.2), 0.0) << "it has not come out yet";
  EXPECT_EQ(strands.step_to(-0.1), 0.0);
  EXPECT_EQ(strands.step_to(0.2), 1.0) << "it has come out";
}

TEST(DeepFoot, PressesWhereTheStrandsCameIntoEachOtherInTheStep) {
  Beside strands;
  EXPECT_EQ(strands.step_to(kFar), 0.0);
  EXPECT_EQ(strands.step_to(1.0), 1.0);
}

TEST(DeepFoot, PressesWhereItAppearsNoDeeperThanAContactCanBegin) {
  Beside strands;
  EXPECT_EQ(strands.step_to(kFar), 0.0);
  strands.close(0.2);
  EXPECT_EQ(strands.step_to(0.2), 1.0);
  EXPECT_EQ(strands.step_to(1.0), 1.0) << "one that pressed before does so however deep it is pushed";
}

/// Two straight strands share their contacts by halves, towards which omega relaxes as dt/(dt + 0.05 s).
TEST(DeepFoot, BeginsWithoutWeightWhereFrictionActsAtTheSurfaces) {
  Beside strands;
  strands.act_at_surface();
  strands.step_to(kFar);
  strands.close(0.2);
  EXPECT_EQ(strands.step_to(0.2), 0.0);
  EXPECT_EQ(strands.step_to(0.2), 1.0);
  EXPECT_NEAR(strands.weighting(), 0.5 * kStep / (kStep + 0.05), 1e-4);
  Beside followed;
  followed.act_at_surface();
  followed.step_to(-0.2);
  EXPECT_EQ(followed.step_to(0.2), 1.0) << "a foot that was there before the strands touched";
  EXPECT_NEAR(followed.weighting(), 0.5, 1e-4);
}

TEST(DeepFoot, PressesHoweverDeepWhereItWasFollowedBefore) {
  Beside strands;
  EXPECT_EQ(strands.step_to(-0.2), 0.0);
  EXPECT_EQ(strands.step_to(1.0), 1.0);
}

TEST(DeepFoot, IsKeptWithTheState) {
  for (const double before : {1.0, -0.1}) {
    Beside strands;
    strands.step_to(kFar);
    strands.close(0.9);
    strands.step_to(1.0);
    strands.step_to(before);
    Beside elsewhere;
    elsewhere.load(strands.saved(), before);
    EXPECT_EQ(elsewhere.saved(), strands.saved());
    EXPECT_EQ(elsewhere.step_to(0.2), before > 0.0 ? 0.0 : 1.0) << before;
  }
  // So is that the first step is over, where no foot was followed yet.
  Beside strands, elsewhere;
  strands.step_to(kFar);
  elsewhere.load(strands.saved(), 0.9);
  EXPECT_EQ(elsewhere.step_to(1.0), 0.0);
}

}  // namespace
}  // namespace knot_utm
