#pragma once

#include <string>
#include <vector>

#include "knot_utm/analysis/rate_shares.hpp"
#include "knot_utm/io/method.hpp"

namespace knot_utm {

/// A test means to be slow: its forces are to be those of any slower one. One line for each share that speed has in
/// them nevertheless, beyond a hundredth of F. `inertia`: mass that is accelerated, over the rod's own.
std::vector<std::string> speed_warnings(const RateShares& rate, double inertia);

/// What the speeds of the method itself tell, before anything has moved.
std::vector<std::string> speed_warnings(const Method& method);

}  // namespace knot_utm
