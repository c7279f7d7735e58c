// A foot that appears deep inside the rod, where its point lay as the step began, belongs to a bend that has closed
// around the point. It takes no part until it has come out. Lengths in radii of the rod.

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "contact/strands.hpp"
#include "knot_utm/contact/smooth_contact.hpp"
#include "knot_utm/numeric/archive.hpp"

namespace knot_utm {
namespace {

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
