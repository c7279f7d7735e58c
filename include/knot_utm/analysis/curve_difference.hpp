#pragma once

#include <optional>

#include "knot_utm/analysis/curve_readings.hpp"

namespace knot_utm {

/// The difference F_b - F_a of two pulls over the extensions that both of them cover. Between two points of a pull the
/// force is interpolated linearly.
struct CurveDifference {
  Range common{0.0, 0.0};   ///< extensions that both pulls cover [m]
  double rms = 0.0;         ///< root mean square of the difference over these extensions [N]
  double largest = 0.0;     ///< the difference of largest size, with its sign [N]
  double largest_at = 0.0;  ///< extension at which it occurs [m]
  double load = 0.0;        ///< largest |F_a| over these extensions, the reference for relative differences [N]
};

/// Empty where the pulls have no extension in common, or where one of them has fewer than two points.
std::optional<CurveDifference> curve_difference(const Pull& a, const Pull& b);

}  // namespace knot_utm
