#include "knot_utm/analysis/pull_readings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "knot_utm/record/sample.hpp"

namespace knot_utm {
namespace {

Pull pull(const std::function<double(double)>& force, double end = 0.1, int points = 1000) {
  Pull out;
  for (int i = 0; i <= points; ++i) {
    const double s = end * i / points;
    out.push_back({s / 3.3e-3, s, Sample::kNone, force(s)});
  }
  return out;
}

/// The pull goes to s = 0.1. A force that rises by a from its middle on to its end differs by a/2 from quarter to
/// quarter.
TEST(PullReadings, SteadyForceIsTheMeanOfASecondHalfThatIsLevel) {
  const auto rising = [](double rise) {
    return pull([rise](double s) { return s < 0.05 ? 200.0 * s : 10.0 + rise * (s - 0.05) / 0.05; });
  };
  EXPECT_NEAR(*steady_force(rising(0.0)), 10.0, 1e-9);
  EXPECT_NEAR(*steady_force(rising(0.3)), 10.15, 1e-9);
  EXPECT_FALSE(steady_force(rising(0.6)));
  EXPECT_FALSE(steady_force(pull([](double s) { return 160.0 * s; })));
  EXPECT_FALSE(steady_force({}));
  EXPECT_FALSE(steady_force({{0.0, 0.1}}));
}

/// F = a s^2: s at a share of the peak is the root of it, and a tenth's least-squares slope is that in its middle.
TEST(PullReadings, OfAParabolaTheyAreItsClosedForms) {
  constexpr double kFactor = 3e4, kEnd = 0.1, kPeak = kFactor * kEnd * kEnd;
  const Pull parabola = pull([](double s) { return kFactor * s * s; });
  const double step = kEnd / 1000.0;
  // A curve drawn straight from point to point is too high by no more than F'' step^2/8.
  const double drawn = 2.0 * kFactor * step * step / 8.0;
  EXPECT_NEAR(energy_to_peak(parabola), kFactor * std::pow(kEnd, 3) / 3.0, drawn * kEnd);
  const double chord = 0.4 * kPeak / (kEnd * (std::sqrt(0.5) - std::sqrt(0.1)));
  EXPECT_NEAR(*chord_stiffness(parabola), chord, chord * 10.0 * drawn / kPeak);
  EXPECT_NEAR(*secant_stiffness(parabola), kFactor * kEnd, 1e-9);
  EXPECT_NEAR(*tangent_stiffness(parabola), 2.0 * kFactor * 0.95 * kEnd, 3.0 * drawn / (0.1 * kEnd));
}

/// 6 N that slide, 2e5 N/m behind s = 0.08 m, and a breakaway above a tenth of the peak.
TEST(PullReadings, OfAKnotThatLocksTheChordIsThatOfTheLock) {
  const auto force = [](double s) {
    return 6.0 * std::min(1.0, s / 1e-3) + 1000.0 * std::exp(-std::pow((s - 0.01) / 1e-3, 2)) +
           2e5 * std::max(0.0, s - 0.08);
  };
  const Pull knot = pull(force);
  EXPECT_NEAR(*chord_stiffness(knot), 2e5, 1e-6);
  EXPECT_NEAR(*secant_stiffness(knot), force(0.1) / 0.1, 1e-6);
  EXPECT_NEAR(*tangent_stiffness(knot), 2e5, 1e-4);
}

TEST(PullReadings, TheEnergyGoesOnBehindThePeakTheStiffnessesDoNot) {
  const Pull tent = pull([](double s) { return s < 0.06 ? 100.0 * s : 6.0 - 1e3 * (s - 0.06); }, 0.062, 620);
  EXPECT_NEAR(energy_to_peak(tent), 0.5 * 0.06 * 6.0, 1e-12);
  EXPECT_NEAR(energy(tent), 0.5 * 0.06 * 6.0 + 0.002 * (6.0 + 4.0) / 2.0, 1e-12);
  EXPECT_NEAR(*secant_stiffness(tent), 100.0, 1e-9);
  EXPECT_NEAR(*tangent_stiffness(tent), 100.0, 1e-9);
}

/// The same as that of each part by itself, whose sums begin with it.
TEST(PullReadings, TheSteepestTenthIsThatOfAllParts) {
  const Pull wild = pull([](double s) { return 1e3 * s + 20.0 * std::sin(300.0 * s) + 2e5 * std::max(0.0, s - 0.07); });
  double steepest = 0.0;
  for (std::size_t i = 0; i + 100 < wild.size(); ++i) {  // least squares of straight pieces, s from the part's middle
    double moment = 0.0, middle = wild[i].extension + 0.005;
    for (std::size_t k = i; k < i + 100; ++k) {
      const double a = wild[k].extension - middle, b = wild[k + 1].extension - middle;
      const double fa = wild[k].force, fb = wild[k + 1].force;
      moment += (b - a) * (2.0 * a * fa + a * fb + b * fa + 2.0 * b * fb) / 6.0;
    }
    steepest = std::max(steepest, 12.0 * moment / std::pow(0.01, 3));
  }
  EXPECT_NEAR(*tangent_stiffness(wild), steepest, 1e-9 * steepest);  // sums of a thousand points, 1e3 times the part's
}

TEST(PullReadings, WhatAPullDoesNotHaveIsEmpty) {
  const Pull one = {{0.0, 0.01, Sample::kNone, 5.0}};
  for (const Pull& nothing : {Pull{}, one}) {
    EXPECT_EQ(energy(nothing), 0.0);
    EXPECT_EQ(energy_to_peak(nothing), 0.0);
    EXPECT_FALSE(chord_stiffness(nothing));
    EXPECT_FALSE(secant_stiffness(nothing));
    EXPECT_FALSE(tangent_stiffness(nothing));
  }
  // Mounted under more than a tenth of the peak.
  const Pull tight = pull([](double s) { return 5.0 + 100.0 * s; });
  EXPECT_FALSE(chord_stiffness(tight));
  EXPECT_NEAR(*secant_stiffness(tight), 100.0, 1e-9);
  const Pull falling = pull([](double s) { return 5.0 - s; });
  EXPECT_FALSE(secant_stiffness(falling));
  EXPECT_FALSE(chord_stiffness(falling));
}

}  // namespace
}  // namespace knot_utm
