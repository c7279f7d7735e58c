#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

namespace knot_utm {

/// A name with numbers in it, as printf writes them: formatted("R4 strut, M = %.1f", moment).
template <typename... Numbers>
std::string formatted(const char* format, Numbers... numbers) {
  char text[256];
  std::snprintf(text, sizeof text, format, numbers...);
  return text;
}

/// Holds a result against a reference, and leaves the pair in the test's report (--gtest_output=json), from which
/// `scripts/validate` makes its table. `what` begins with the number of doc/references.md: "R8 capstan, T = 2".
/// Passes where |ours - reference| <= gate |reference|.
inline void hold_against(const std::string& what, double reference, double ours, double gate) {
  testing::Test::RecordProperty("reference: " + what, formatted("%.17g %.17g %.17g", reference, ours, gate));
  EXPECT_LE(std::abs(ours - reference), gate * std::abs(reference))
      << what << ": ours " << ours << ", reference " << reference;
}

/// The same for a result that must stay below a bound: passes where 0 <= ours < bound.
inline void hold_below(const std::string& what, double bound, double ours) {
  testing::Test::RecordProperty("reference: " + what, formatted("< %.17g %.17g", bound, ours));
  EXPECT_GE(ours, 0.0) << what;
  EXPECT_LT(ours, bound) << what << ": ours " << ours << ", bound " << bound;
}

}  // namespace knot_utm
