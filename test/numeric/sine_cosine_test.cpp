#include "knot_utm/numeric/sine_cosine.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace knot_utm {
namespace {

void expect_same_as_library(const Lanes& angle, double tolerance) {
  const auto [sine, cosine] = sine_cosine(angle);
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(sine[k], std::sin(angle[k]), tolerance * std::abs(std::sin(angle[k]))) << angle[k];
    EXPECT_NEAR(cosine[k], std::cos(angle[k]), tolerance * std::abs(std::cos(angle[k]))) << angle[k];
  }
}

constexpr double kRounding = 2.0 * std::numeric_limits<double>::epsilon();

TEST(SineCosine, IsThatOfTheLibraryInEveryQuarter) {
  for (int n = -4000; n < 4000; ++n) {
    const double angle = 0.01 * n;
    expect_same_as_library(Lanes{angle, angle + 1e3, 1e4 - angle, 9e5 + angle}, kRounding);
  }
}

TEST(SineCosine, HoldsAtQuarterTurnsAndBesideThem) {
  for (int n = -9; n < 10; ++n) {
    const double quarters = n * 0.5 * M_PI, eighth = quarters + 0.25 * M_PI;
    expect_same_as_library(Lanes{quarters, eighth, std::nextafter(eighth, 0.0), quarters + 1e-9}, kRounding);
  }
  expect_same_as_library(Lanes{0.0, 1e-300, -1e-20, 1e-8}, kRounding);
}

TEST(SineCosine, LeavesLongAnglesToTheLibrary) {
  expect_same_as_library(Lanes{1e6, -3e7, 1e15, 0.5}, kRounding);
  const auto [sine, cosine] = sine_cosine(constant<Lanes>(std::numeric_limits<double>::infinity()));
  EXPECT_TRUE(std::isnan(sine[0]) && std::isnan(cosine[3]));
}

}  // namespace
}  // namespace knot_utm
