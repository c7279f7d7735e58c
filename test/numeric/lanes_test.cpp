#include "knot_utm/numeric/lanes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace knot_utm {

namespace {

constexpr double kA[4] = {1.5, -2.25, 0.1, -0.0}, kB[4] = {0.3, -2.25, 7.0, 1e-300};

LanesInTwo four(const double* v) { return {v[0], v[1], v[2], v[3]}; }

// To the bit, so that signs of zero count.
void expect_same(const LanesInTwo& lanes, const double (&expected)[4]) {
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(lanes[i], expected[i]) << i;
    EXPECT_EQ(std::signbit(lanes[i]), std::signbit(expected[i])) << i;
  }
}

}  // namespace

// Formulas are written once for both kinds of lanes: one in two registers must do in each lane what a double does. It
// is tested on every processor, also where the solver takes registers of four.
TEST(LanesInTwo, EveryLaneIsADouble) {
  const LanesInTwo a = four(kA), b = four(kB);
  double sum[4], difference[4], product[4], quotient[4], negative[4], scaled[4], left[4];
  for (int i = 0; i < 4; ++i) {
    sum[i] = kA[i] + kB[i];
    difference[i] = kA[i] - kB[i];
    product[i] = kA[i] * kB[i];
    quotient[i] = kA[i] / kB[i];
    negative[i] = -kA[i];
    scaled[i] = 3.0 * kA[i];
    left[i] = 1.0 - kA[i];
  }
  expect_same(a + b, sum);
  expect_same(a - b, difference);
  expect_same(a * b, product);
  expect_same(a / b, quotient);
  expect_same(-a, negative);
  expect_same(3.0 * a, scaled);
  expect_same(1.0 - a, left);
  LanesInTwo changed = a;
  changed += b;
  expect_same(changed, sum);
  changed = a;
  changed -= b;
  expect_same(changed, difference);
  changed = a;
  changed *= b;
  expect_same(changed, product);
}

TEST(LanesInTwo, ComparesAndSelectsByLane) {
  const LanesInTwo a = four(kA), b = four(kB);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ((a < b)[i] != 0, kA[i] < kB[i]) << i;
    EXPECT_EQ((a > b)[i] != 0, kA[i] > kB[i]) << i;
    EXPECT_EQ((a <= b)[i] != 0, kA[i] <= kB[i]) << i;
    EXPECT_EQ((a >= b)[i] != 0, kA[i] >= kB[i]) << i;
    EXPECT_EQ((~(a < b))[i] != 0, !(kA[i] < kB[i])) << i;
    EXPECT_EQ(select(a < b, a, b)[i], kA[i] < kB[i] ? kA[i] : kB[i]) << i;
    EXPECT_EQ(((a < b) | (a > b))[i] != 0, kA[i] != kB[i]) << i;
    LanesInTwoMask either = a < b;
    either |= a > b;
    EXPECT_EQ(either[i] != 0, kA[i] != kB[i]) << i;
    LanesInTwoMask both = a < b;
    both &= a <= b;
    EXPECT_EQ(both[i] != 0, kA[i] < kB[i]) << i;
    LanesInTwo only = LanesInTwo{};
    only[i] = 1.0;
    EXPECT_TRUE(any(only > 0.0)) << i;
  }
  EXPECT_FALSE(any(a > std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(any((a < b) & (a > b)));
}

TEST(LanesInTwo, MovesLanes) {
  LanesInTwo rows[4];
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) rows[i][j] = 10.0 * i + j;
  const LanesInTwo before = rows[0], now = rows[1];
  expect_same(one_later(before, now), {3.0, 10.0, 11.0, 12.0});
  expect_same(one_earlier(before, now), {1.0, 2.0, 3.0, 10.0});
  transpose(rows[0], rows[1], rows[2], rows[3]);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) EXPECT_EQ(rows[i][j], 10.0 * j + i) << i << j;
}

}  // namespace knot_utm
