#include "knot_utm/machine/load_cell.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace knot_utm {
namespace {

TEST(LoadCell, ReadsTheTrueForceUnlessToldOtherwise) {
  LoadCell cell{LoadCellOptions()};
  EXPECT_EQ(cell.read(12.345), 12.345);
  cell.balance(2.0);
  EXPECT_EQ(cell.read(12.5), 10.5);
  EXPECT_EQ(cell.balanced(2.0), 0.0);
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

/// Of 400 cells of one class; and reading two forces tells the gain of each.
TEST(LoadCell, AccuracyIsAnErrorOfTheGainWithinItsBoundsAndAllOverThem) {
  constexpr int kCells = 400;
  double sum = 0.0, squares = 0.0;
  for (unsigned seed = 0; seed < kCells; ++seed) {
    LoadCellOptions options;
    options.accuracy = 0.005;
    options.seed = seed;
    LoadCell cell(options);
    cell.balance(10.0);
    const double share = (cell.read(110.0) - 100.0) / (100.0 * options.accuracy);
    EXPECT_NEAR(cell.read(-190.0), -2.0 * cell.read(110.0), 1e-10);
    EXPECT_EQ(cell.read(10.0), 0.0);
    EXPECT_LE(std::abs(share), 1.0);
    sum += share;
    squares += share * share;
  }
  // Five standard deviations of mean and mean square of a uniform distribution from -1 to 1.
  EXPECT_NEAR(sum / kCells, 0.0, 5.0 * std::sqrt(1.0 / 3.0 / kCells));
  EXPECT_NEAR(squares / kCells, 1.0 / 3.0, 5.0 * std::sqrt(4.0 / 45.0 / kCells));
}

TEST(LoadCell, ReadsItsStopWhereItIsOverloaded) {
  LoadCellOptions options;
  options.capacity = 20.0;
  EXPECT_EQ(LoadCell(options).read(1e3), 1e3) << "no stop unless told";
  options.overload = 1.5;
  LoadCell cell(options);
  cell.balance(2.0);
  EXPECT_EQ(cell.read(29.0), 27.0);
  EXPECT_EQ(cell.read(31.0), 28.0);
  EXPECT_EQ(cell.read(-1e3), -32.0);
}

TEST(LoadCell, ItsClassSaysHowFarAReadingMayBeOff) {
  LoadCellOptions cell;
  cell.capacity = 1000.0;
  EXPECT_FALSE(class_error(cell, 100.0));
  cell.accuracy = 0.005;
  EXPECT_DOUBLE_EQ(*class_error(cell, -100.0), 0.5);
  cell.floor = 0.01;
  EXPECT_DOUBLE_EQ(*class_error(cell, 10.0), 0.05);
  EXPECT_DOUBLE_EQ(*class_error(cell, 9.9), 10.0);
  EXPECT_TRUE(is_below_floor(cell, -9.9));
  EXPECT_FALSE(is_below_floor(cell, 10.0));
}

}  // namespace
}  // namespace knot_utm
