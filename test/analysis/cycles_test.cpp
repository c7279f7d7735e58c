#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "knot_utm/analysis/pull_readings.hpp"

namespace knot_utm {
namespace {

/// Straight from each place to the next, in 200 steps; F by s and which way it goes.
Path path(const std::vector<double>& places, const std::function<double(double s, bool out)>& force) {
  constexpr int kSteps = 200;
  Path out;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double from = places[i - 1], to = places[i];
    for (int k = i == 1 ? 0 : 1; k <= kSteps; ++k) {
      const double s = from + (to - from) * k / kSteps;
      out.push_back({s, force(s, to > from), s});
    }
  }
  return out;
}

/// A spring with dry friction beside it: 2 N more on the way out, 2 N less on the way back.
double rubbing_spring(double s, bool out) { return 200.0 * s + (out ? 2.0 : -2.0); }

TEST(ClosedCycles, OfDryFrictionTheAreaIsTwiceItsForceTimesTheWay) {
  const Path to_and_fro = path({0.0, 0.1, 0.0, 0.1, 0.0}, rubbing_spring);
  const std::vector<Cycle> cycles = closed_cycles(to_and_fro);
  ASSERT_EQ(cycles.size(), 2u);
  // Where it turns F falls within one step, along which the curve is straight.
  const double corner = 2.0 * 2.0 * 0.1 / 200.0;
  for (const Cycle& cycle : cycles) EXPECT_NEAR(cycle.hysteresis, 2.0 * 2.0 * 0.1, 1.01 * corner);
  EXPECT_EQ(cycles[0].end, cycles[1].begin);
}

TEST(ClosedCycles, TheWayToWhereTheyBeginAndWhatWasCutOffAreNone) {
  const std::vector<Cycle> cycles = closed_cycles(path({0.0, 0.1, 0.05, 0.1, 0.05, 0.1, 0.07}, rubbing_spring));
  ASSERT_EQ(cycles.size(), 1u);
  EXPECT_NEAR(cycles[0].hysteresis, 2.0 * 2.0 * 0.05, 1.01 * 2.0 * 2.0 * 0.05 / 200.0);
  EXPECT_EQ(cycles[0].begin, 400u);
  EXPECT_EQ(cycles[0].end, 800u);
  EXPECT_TRUE(closed_cycles(path({0.0, 0.1, 0.05}, rubbing_spring)).empty());
  EXPECT_TRUE(closed_cycles(path({0.1, 0.0, 0.1}, rubbing_spring)).empty()) << "back and out";
}

/// Between two loads: F comes back where s does not. The end is joined to the beginning at that load.
TEST(ClosedCycles, BetweenLoadsTheyCreepAndAreClosedAllTheSame) {
  Path creeping = {{0.0, 0.0}, {0.1, 10.0}, {0.05, 0.0}, {0.12, 10.0}, {0.08, 0.0}, {0.14, 10.0}, {0.11, 0.0}};
  for (PathPoint& point : creeping) point.crosshead = point.extension;
  const std::vector<Cycle> cycles = closed_cycles(creeping);
  ASSERT_EQ(cycles.size(), 3u);
  EXPECT_NEAR(cycles[0].hysteresis, 5.0 * (0.1 - 0.05), 1e-12);
  EXPECT_NEAR(cycles[1].hysteresis, 5.0 * (0.07 - 0.04), 1e-12);
  EXPECT_NEAR(cycles[2].hysteresis, 5.0 * (0.06 - 0.03), 1e-12);
}

/// The slack of a knot is taken up in the step that cycles: its cycles are a hundredth of that way.
TEST(ClosedCycles, SlackThatTheFirstOfThemTakesUpHidesNone) {
  const std::vector<double> places = {0.0, 0.1, 0.099, 0.1, 0.099, 0.1, 0.099};
  const auto knot = [](double s, bool out) { return std::max(0.0, 1e4 * (s - 0.0985)) + (out ? 2.0 : 0.0); };
  const std::vector<Cycle> cycles = closed_cycles(path(places, knot));
  ASSERT_EQ(cycles.size(), 2u) << "but not the way to where they begin";
  for (const Cycle& cycle : cycles) EXPECT_NEAR(cycle.hysteresis, 2.0 * 1e-3, 1.01 * 2.0 * 1e-3 / 200.0);
}

}  // namespace
}  // namespace knot_utm
