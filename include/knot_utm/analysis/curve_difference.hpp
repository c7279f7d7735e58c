#pragma once

#include <optional>

#include "knot_utm/analysis/curve_readings.hpp"

namespace knot_utm {

/// F_b - F_a over the extensions that two pulls have in common, both straight from point to point.
struct CurveDifference {
  Range common{0.0, 0.0};   ///< [m]
  double rms = 0.0;         ///< root of the mean square over extension [N]
  double largest = 0.0;     ///< in size, with its sign [N]
  double largest_at = 0.0;  ///< [m]
  double load = 0.0;        ///< largest |F_a| there, to measure the others by [N]
};

/// None where they have no extension in common.
std::optional<CurveDifference> curve_difference(const Pull& a, const Pull& b);

}  // namespace knot_utm
