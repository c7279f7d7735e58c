#pragma once

#include <string>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/method/method.hpp"

namespace knot_utm {

/// Warnings where speed affects the forces of a test, which is meant to be quasi-static. There is one line for each
/// effect (drag, inertia) that exceeds a hundredth of F. `inertia`: accelerated mass over the rod's own mass [-].
std::vector<std::string> speed_warnings(const RateShares& rate, double inertia);

/// A warning where a node moved more than a hundred times as fast as the pull before the knots locked, although no knot
/// jumped open. Elastic energy of stretchy strands or of a compliant frame was then released suddenly. `pull_speed` in
/// m/s; 0: not known.
std::vector<std::string> snap_warnings(const Results& results, double pull_speed);

/// Warnings about speeds of the method, before anything moves.
std::vector<std::string> speed_warnings(const Method& method);

}  // namespace knot_utm
