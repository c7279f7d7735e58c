#pragma once

#include <functional>
#include <optional>
#include <string>

namespace knot_utm {

/// Safety margin of a knot that slides: the fraction by which friction or the pre-load would have to be lower for the
/// knot to open.
struct Margin {
  /// Largest fraction that is tried. A knot that still holds there has a margin of at least this.
  static constexpr double kMost = 0.75;

  std::optional<double> friction;  ///< fraction of mu [-]
  std::optional<double> preload;   ///< fraction of F_p [-]
  std::string reason;              ///< why there is no margin; empty: there is one, or none was asked for
};

/// Finds the fraction by which a quantity is to be lowered until the knot opens. `opens(factor)` runs a test in which
/// the quantity is multiplied by `factor`, and says whether the knot opened. The knot is assumed to hold at a factor of
/// 1, and to open at every factor below one at which it opens. After a run at 1 - kMost, three geometric bisections
/// enclose the factor; the result is the geometric mean of what is left, within a tenth of the true factor.
double fraction_until_it_opens(const std::function<bool(double)>& opens);

}  // namespace knot_utm
