#include "knot_utm/machine/break_detector.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "knot_utm/record/sample.hpp"

namespace knot_utm {
namespace {

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

TEST(BreakDetector, OffItSeesNone) { EXPECT_EQ(break_in({}, pull_of({0.0, 100.0, 0.0})), -1); }

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

TEST(BreakDetector, SaysWhatFell) {
  BreakDetector detector({0.5, 0.0});
  EXPECT_EQ(detector.judge(pull_of({80.0})[0]), "");
  EXPECT_EQ(detector.judge(pull_of({20.0})[0]), "the load fell from 80 to 20 N");
}

}  // namespace
}  // namespace knot_utm
