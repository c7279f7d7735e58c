// Which drop of the load is taken for a break, and which time steps of a rod that can part are believed.
#include "knot_utm/breaking/break_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "knot_utm/program/program_runner.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// A pull at 1 mm and 0.1 s a command, each one time step, whose loads are these [N].
std::vector<Sample> pull_of(const std::vector<double>& loads) {
  std::vector<Sample> out;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    Sample sample;
    sample.time = 0.1 * static_cast<double>(i);
    sample.extension = 1e-3 * static_cast<double>(i);
    sample.load = sample.force_upper = sample.highest_load = sample.lowest_load = loads[i];
    out.push_back(sample);
  }
  return out;
}

/// The sample that is taken for a break; -1: none.
int break_in(const BreakDetection& detection, const std::vector<Sample>& samples) {
  BreakDetector detector(detection);
  detector.begin();
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (!detector.judge(samples[i]).empty()) return static_cast<int>(i);
  return -1;
}

TEST(BreakDetector, FractionOfPeakCountsOnceArmed) {
  BreakDetection detection;
  detection.fraction_of_peak = 0.4;
  const std::vector<Sample> pull = pull_of({0.0, 5.0, 1.0, 50.0, 100.0, 41.0, 40.0, 10.0});
  EXPECT_EQ(break_in(detection, pull), 2);
  detection.arming_load = 20.0;
  EXPECT_EQ(break_in(detection, pull), 6);
  detection.arming_load = 101.0;
  EXPECT_EQ(break_in(detection, pull), -1);
}

/// Seen at the physics' own rate: the cell, read at the ends of commands, knows nothing of it.
TEST(BreakDetector, SeesADropBetweenTwoReadings) {
  BreakDetection detection;
  detection.fraction_of_peak = 0.5;
  std::vector<Sample> pull = pull_of({0.0, 100.0, 101.0, 102.0});
  EXPECT_EQ(break_in(detection, pull), -1);
  pull[2].lowest_load = 30.0;
  EXPECT_EQ(break_in(detection, pull), 2);
}

TEST(BreakDetector, ARiseWithinOneCommandIsNoDrop) {
  BreakDetection detection;
  detection.fraction_of_peak = 0.2;
  std::vector<Sample> pull = pull_of({0.0, 1.0, 1000.0, 5000.0});
  for (std::size_t i = 1; i < pull.size(); ++i) pull[i].lowest_load = pull[i - 1].load;
  EXPECT_EQ(break_in(detection, pull), -1);
}

constexpr double kShortest = 1e-3;  // [s]

Exposure at(double fraction) { return {fraction, 0, BreakLimit::kForce, 600.0 * fraction}; }

/// Follows the tensions that steps would end with, each over what the rod bears, as the machine does: a step that is
/// refused is tried again at half its length, in which the tension rises by half, as far as `least` [s].
struct Followed {
  double parted_at = 0.0;  ///< over the strength; 0: it is whole
  std::string refused;     ///< why the shortest step was
};

Followed follow(const std::vector<double>& fractions, double dt, double least) {
  BreakWatch watch(kShortest, at(0.0));
  double before = 0.0;
  for (const double fraction : fractions) {
    double reached = fraction, tried = dt;
    std::string why = watch.refuse(at(reached), tried);
    while (!why.empty()) {
      if (tried < least) return {0.0, why};
      tried *= 0.5;
      reached = before + 0.5 * (reached - before);
      why = watch.refuse(at(reached), tried);
    }
    if (watch.judge(at(reached), tried)) return {reached, ""};
    before = reached;
  }
  return {};
}

TEST(BreakWatch, ARodPartsAtItsStrengthHoweverBrittleItIs) {
  EXPECT_EQ(follow({0.2, 0.6, 0.9}, 0.3, 1e-7).parted_at, 0.0);
  EXPECT_EQ(follow({0.2, 0.6, 1.0}, 0.3, 1e-7).parted_at, 1.0);
  // A step that is 64 times too long is cut until it leads to the strength, or just below it, from where others go on.
  const Followed brittle = follow(std::vector<double>(20, 64.0), 0.3, 1e-7);
  EXPECT_GE(brittle.parted_at, 1.0);
  EXPECT_LE(brittle.parted_at, 1.001);
  EXPECT_THAT(brittle.refused, IsEmpty());
}

/// As of a loop that a roller ran into: whatever the tension was before, and however short the step is.
TEST(BreakWatch, NoStepLeadsToAMultipleOfTheStrength) {
  for (const double before : {0.0, 0.3, 0.6, 0.99})
    for (const double dt : {0.3, 1e-3, 1.6e-7}) {
      const std::string why = BreakWatch(kShortest, at(before)).refuse(at(1500.0), dt);
      EXPECT_THAT(why, HasSubstr("the tension would jump from")) << before << ' ' << dt;
      EXPECT_THAT(why, HasSubstr("to 1500 times what the rod bears"));
    }
  EXPECT_THAT(BreakWatch(kShortest, at(0.9)).refuse(at(1.5), 1.6e-7), IsEmpty()) << "a knot that lets go";
}

TEST(BreakWatch, TheNextStepEndsWhereTheRodParts) {
  BreakWatch watch(kShortest, at(0.0));
  ASSERT_FALSE(watch.judge(at(0.4), 0.2));
  ASSERT_FALSE(watch.judge(at(0.8), 0.2));
  EXPECT_NEAR(watch.next(), 0.1, 1e-12);
  ASSERT_FALSE(watch.judge(at(0.999999), 0.1));
  EXPECT_EQ(watch.next(), kShortest);
}

TEST(BreakWatch, NoRodPartsByTensionWhileItsGripsArePressedTogether) {
  EXPECT_THAT(not_by_tension(at(1.0), -8.9e5, -9e5), HasSubstr("pressed together by 890000 N"));
  EXPECT_THAT(not_by_tension(at(1.0), 600.0, 600.0), IsEmpty());
  EXPECT_THAT(not_by_tension(at(1.0), -12.0, 600.0), IsEmpty()) << "under a weight along +z";
  EXPECT_THAT(not_by_tension(at(1.0), 600.0, -12.0), IsEmpty()) << "under its own weight";
  EXPECT_THAT(not_by_tension(at(1.0), -1e-6, -2e-6), IsEmpty()) << "a loop that parts while it is tied";
  // A rod that buckles parts where it is bent most.
  EXPECT_THAT(not_by_tension({1.0, 0, BreakLimit::kStrain, 0.2}, -3.0, -3.0), IsEmpty());
}

}  // namespace
}  // namespace knot_utm
