#include "knot_utm/rod/turning_angle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace knot_utm {
namespace {

double w_of(double angle) { return std::sin(0.5 * angle) * std::sin(0.5 * angle); }

double squared(double angle) {
  const double w = w_of(angle);
  return w * squared_angle_over(w).value;
}

TEST(SquaredAngle, IsThatOfTheAngleWhereEdgesResolveTheBend) {
  const std::pair<double, double> bounds[] = {
      {0.1, 1e-15}, {0.5, 8e-10}, {1.0, 3e-6}, {0.5 * M_PI, 5.1e-4}, {2.0, 9e-3}};
  for (const auto& [angle, relative] : bounds)
    EXPECT_NEAR(squared(angle), angle * angle, relative * angle * angle) << "at " << angle << " rad";
}

TEST(SquaredAngle, KeepsItsDigitsWhereTheRodIsNearlyStraight) {
  for (const double angle : {1e-3, 1e-7, 1e-12, 1e-100})
    EXPECT_NEAR(squared(angle) / (angle * angle), 1.0, 1e-14) << "at " << angle << " rad";
}

/// Never less than phi^2, ever steeper, and without bound: the moment k_b/lbar dg/dphi/2 that holds against folding.
TEST(SquaredAngle, HoldsAgainstFolding) {
  constexpr double kStep = 1e-3;
  double before = squared(0.0), slope_before = 0.0;
  for (double angle = kStep; angle < M_PI - 0.5 * kStep; angle += kStep) {
    const double here = squared(angle), slope = (here - before) / kStep;
    EXPECT_GE(here, angle * angle * (1.0 - 4e-15)) << "at " << angle << " rad";
    EXPECT_GT(slope, slope_before) << "at " << angle << " rad";
    before = here;
    slope_before = slope;
  }
  for (const double short_of_a_fold : {1e-2, 1e-3, 1e-4}) {
    const double pole = std::cos(0.5 * (M_PI - short_of_a_fold));  // sqrt(1 - w)
    EXPECT_NEAR(squared(M_PI - short_of_a_fold) * pole * pole, kTurningSeries.last, 0.03);
  }
}

TEST(SquaredAngle, DerivativesAreThoseOfTheValue) {
  constexpr double kStep = 1e-6;
  for (const double w : {0.0, 1e-9, 0.01, 0.2, 0.5, 0.8, 0.9}) {
    const auto here = squared_angle_over(w), ahead = squared_angle_over(w + kStep),
               behind = squared_angle_over(w - kStep);
    const double first = (ahead.value - behind.value) / (2.0 * kStep);
    const double second = (ahead.first - behind.first) / (2.0 * kStep);
    EXPECT_NEAR(here.first, first, 1e-8 * std::abs(first)) << "w = " << w;
    EXPECT_NEAR(here.second, second, 1e-8 * std::abs(second)) << "w = " << w;
  }
}

TEST(TurningAngle, IsThatBetweenTheTangents) {
  for (const double angle : {0.0, 1e-9, 0.3, 2.0, M_PI - 1e-9, M_PI})
    EXPECT_NEAR(turning_angle(Vec3::UnitX(), {std::cos(angle), 0.0, std::sin(angle)}), angle, 1e-15 * M_PI);
}

}  // namespace
}  // namespace knot_utm
