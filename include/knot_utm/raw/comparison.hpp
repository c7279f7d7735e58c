#pragma once

#include <optional>
#include <string>
#include <vector>

#include "knot_utm/analysis/curve_difference.hpp"
#include "knot_utm/raw/raw_zero.hpp"

namespace knot_utm {

/// The zeros that the curves were given. Empty: the curve has its own.
struct GivenZeros {
  std::optional<RawZero> a, b;
};

/// The readings of two pulls, both read by the same code (curve_readings.hpp), and the difference of their forces.
struct Comparison {
  CurveReadings a, b;
  std::optional<CurveDifference> difference;  ///< empty where they have no extension in common
  std::optional<GivenZeros> zeros;            ///< empty where the curves were compared as they are
};

Comparison compare(const Pull& a, const Pull& b);

/// The comparison as YAML. For each reading it gives that of A, that of B, B - A, and (B - A)/A; null stands for what
/// does not exist.
std::string comparison_yaml(const Comparison& comparison, const std::string& file_a, const std::string& file_b);

/// One line for each value that exceeds a relative tolerance. The values are the RMS difference of the forces, over A's
/// largest load in the common range, and the difference of each reading, over that of A. A reading that only one of the
/// two has exceeds every tolerance.
std::vector<std::string> beyond_tolerance(const Comparison& comparison, double tolerance);

}  // namespace knot_utm
