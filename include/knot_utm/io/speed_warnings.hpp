#pragma once

#include <string>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/io/method.hpp"

namespace knot_utm {

/// A test means to be slow: its forces are to be those of any slower one. One line for each share that speed has in
/// them nevertheless, beyond a hundredth of F. `inertia`: mass that is accelerated, over the rod's own.
std::vector<std::string> speed_warnings(const RateShares& rate, double inertia);

/// Where a node moved a hundred times as fast as the pull before the knots locked, though no knot jumped open: elastic
/// energy, of strands that stretch or of a compliant frame, let go at once. `pull_speed` in m/s; 0: not known.
std::vector<std::string> snap_warnings(const Results& results, double pull_speed);

/// What the speeds of the method itself tell, before anything has moved.
std::vector<std::string> speed_warnings(const Method& method);

}  // namespace knot_utm
