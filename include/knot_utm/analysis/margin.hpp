#pragma once

#include <functional>
#include <optional>
#include <string>

namespace knot_utm {

/// How far a knot that slides is from opening, as the fraction by which friction or the pre-load would have to be
/// lower.
struct Margin {
  /// Largest fraction that is looked for: a knot that still holds there has a margin of at least this.
  static constexpr double kMost = 0.75;

  std::optional<double> friction;  ///< of mu [-]
  std::optional<double> preload;   ///< of F_p [-]
  std::string reason;              ///< why there is none; empty: there is one, or nobody asked
};

/// Bisects for the fraction by which something is to be lowered until the knot opens; `opens(factor)` runs a test with
/// it multiplied by `factor`. The knot holds at 1. A geometric bisection of three runs behind the one at 1 - kMost, and
/// the middle of what is left: the factor is known within a tenth. Takes the knot to open at every lower factor, too.
double fraction_until_it_opens(const std::function<bool(double)>& opens);

}  // namespace knot_utm
