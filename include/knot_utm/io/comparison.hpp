#pragma once

#include <optional>
#include <string>
#include <vector>

#include "knot_utm/analysis/curve_difference.hpp"

namespace knot_utm {

/// Two pulls, and what each says by the same code (curve_readings.hpp).
struct Comparison {
  CurveReadings a, b;
  std::optional<CurveDifference> difference;  ///< none where they have no extension in common
};

Comparison compare(const Pull& a, const Pull& b);

/// As YAML: of each reading that of A, that of B, B - A and that over A; null where there is none.
std::string comparison_yaml(const Comparison& comparison, const std::string& file_a, const std::string& file_b);

/// What is beyond a relative tolerance, a line each: the RMS difference over A's largest load where both are, and each
/// reading's difference over A's. A reading that only one of them has is beyond any.
std::vector<std::string> beyond_tolerance(const Comparison& comparison, double tolerance);

}  // namespace knot_utm
