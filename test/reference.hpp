#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

namespace knot_utm {

/// Holds a result against a reference, and leaves the pair in the test's report (--gtest_output=json), from which
/// `scripts/validate` makes its table. `what` begins with the number of doc/references.md: "R8 capstan, T = 2".
/// Passes where |ours - reference| <= gate |reference|.
inline void hold_against(const std::string& what, double reference, double ours, double gate) {
  char numbers[128];
  std::snprintf(numbers, sizeof numbers, "%.17g %.17g %.17g", reference, ours, gate);
  testing::Test::RecordProperty("reference: " + what, numbers);
  EXPECT_LE(std::abs(ours - reference), gate * std::abs(reference))
      << what << ": ours " << ours << ", reference " << reference;
}

}  // namespace knot_utm
