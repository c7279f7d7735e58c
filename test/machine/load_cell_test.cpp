#include "knot_utm/machine/load_cell.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "knot_utm/rod/invalid_input.hpp"

namespace knot_utm {
namespace {

TEST(LoadCell, ReadsTheTrueForceUnlessToldOtherwise) {
  LoadCell cell{LoadCellOptions()};
  EXPECT_EQ(cell.read(12.345), 12.345);
  cell.balance(2.0);
  EXPECT_EQ(cell.read(12.5), 10.5);
  EXPECT_EQ(cell.balanced(2.0), 0.0);
}

TEST(LoadCell, ResolutionRoundsToTheNearest) {
  LoadCellOptions options;
  options.resolution = 0.5;
  LoadCell cell(options);
  EXPECT_EQ(cell.read(1.26), 1.5);
  EXPECT_EQ(cell.read(-1.2), -1.0);
}

TEST(LoadCell, NoiseHasItsDeviationAndFollowsFromTheSeed) {
  LoadCellOptions options;
  options.noise = 0.1;
  LoadCell cell(options);
  LoadCell same(options);
  options.seed = 2;
  LoadCell other(options);
  constexpr int kReadings = 20000;
  double sum = 0.0;
  double squares = 0.0;
  int equal = 0;
  for (int i = 0; i < kReadings; ++i) {
    const double reading = cell.read(5.0);
    EXPECT_EQ(same.read(5.0), reading);
    equal += other.read(5.0) == reading ? 1 : 0;
    sum += reading - 5.0;
    squares += (reading - 5.0) * (reading - 5.0);
  }
  // Five standard deviations of mean and of variance.
  EXPECT_NEAR(sum / kReadings, 0.0, 5.0 * 0.1 / std::sqrt(kReadings));
  EXPECT_NEAR(squares / kReadings, 0.01, 5.0 * 0.01 * std::sqrt(2.0 / kReadings));
  EXPECT_LT(equal, 3);
}

TEST(LoadCell, TakesNoNonsense) {
  LoadCellOptions options;
  options.capacity = 0.0;
  EXPECT_THROW(LoadCell{options}, InvalidInput);
  options.capacity = 1.0;
  options.noise = -1.0;
  EXPECT_THROW(LoadCell{options}, InvalidInput);
}

}  // namespace
}  // namespace knot_utm
