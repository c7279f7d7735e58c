#pragma once

#include <functional>

#include "knot_utm/method/method.hpp"
#include "knot_utm/verdict/run_facts.hpp"

namespace knot_utm {

/// Finds the safety margin of a method's knot by short tests with accuracy `draft`, one after the other. Each test ties
/// and mounts the specimen, and pulls it by a fifth of the knot distance, which is beyond breakaway. The knot opens in
/// a test if it comes undone or jumps open (curve_readings.hpp). The same test gives the same margin, to the last bit.
/// `interrupted()` is called between commands and says whether to stop.
Margin find_margin(const Method& method, const std::function<bool()>& interrupted);

/// Finds the fraction by which a quantity is to be lowered until the knot opens. `opens(factor)` runs a test in which
/// the quantity is multiplied by `factor`, and says whether the knot opened. The knot is assumed to hold at a factor of
/// 1, and to open at every factor below one at which it opens. After a run at 1 - kMost, three geometric bisections
/// enclose the factor; the result is the geometric mean of what is left, within a tenth of the true factor.
double fraction_until_it_opens(const std::function<bool(double)>& opens);

}  // namespace knot_utm
