#include "knot_utm/analysis/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace knot_utm {
namespace {

/// Three digits behind the point as tables print them (ISO 2602, table 1).
TEST(Statistics, StudentsPointIsThatOfTheTables) {
  EXPECT_NEAR(student_95(1), 12.706, 5e-4);
  EXPECT_NEAR(student_95(4), 2.776, 5e-4);
  EXPECT_NEAR(student_95(9), 2.262, 5e-4);
  EXPECT_NEAR(student_95(120), 1.980, 5e-4);
}

TEST(Statistics, FiveReadings) {
  const Statistics s = statistics_of({2.0, 4.0, 4.0, 5.0, 10.0});
  EXPECT_EQ(s.n, 5u);
  EXPECT_DOUBLE_EQ(*s.mean, 5.0);
  EXPECT_DOUBLE_EQ(*s.sd, 3.0);  // 9 + 1 + 1 + 0 + 25 = 36 over 4
  EXPECT_DOUBLE_EQ(*s.cv, 0.6);
  EXPECT_DOUBLE_EQ(*s.minimum, 2.0);
  EXPECT_DOUBLE_EQ(*s.maximum, 10.0);
  EXPECT_NEAR(*s.high - *s.mean, 2.776 * 3.0 / std::sqrt(5.0), 1e-3);
  EXPECT_NEAR(*s.mean - *s.low, *s.high - *s.mean, 1e-12);
}

TEST(Statistics, WhatTooFewReadingsDoNotTellIsNotSaid) {
  const Statistics none = statistics_of({});
  EXPECT_FALSE(none.mean || none.sd || none.minimum);
  const Statistics one = statistics_of({3.0});
  EXPECT_EQ(*one.mean, 3.0);
  EXPECT_FALSE(one.sd || one.cv || one.low || one.high);
  const Statistics about_zero = statistics_of({-1.0, 1.0});
  EXPECT_TRUE(about_zero.sd);
  EXPECT_FALSE(about_zero.cv);
}

TEST(Statistics, WhatIsConstantButForRoundingHasNoSpread) {
  for (const std::vector<double>& same : {std::vector<double>{31.000374, 31.000419, 31.000331},
                                          {-0.25, -0.25 * (1.0 + 1e-15)},
                                          {1e-15, -3e-14},
                                          {0.0, 0.0}}) {
    const Statistics s = statistics_of(same);
    EXPECT_FALSE(s.sd || s.cv || s.low || s.high) << same.front();
    EXPECT_EQ(s.n, same.size());
    EXPECT_EQ(*s.maximum, *std::max_element(same.begin(), same.end()));
  }
  EXPECT_TRUE(statistics_of({31.0, 31.01}).sd);
}

}  // namespace
}  // namespace knot_utm
