#pragma once

#include <optional>
#include <vector>

#include "knot_utm/record/sample.hpp"

namespace knot_utm {

/// How far a pull is from a slow one, whose forces know no time. Over the pull up to the lock, else to where the knot
/// comes undone, the rod parts or the pull ends; from every accepted step. Each is the change of an energy on a piece
/// of the way, over that piece and the mean of F: half of the way has less, half has more. The energy of jumps is on
/// little of the way, so that it does not count.
struct RateShares {
  std::optional<double> drag;       ///< of what drag takes [-]
  std::optional<double> inertia;    ///< of kinetic energy: mass that gains or loses speed [-]
  std::optional<double> numerical;  ///< of what the time steps take, or give [-]
};

RateShares rate_shares(const std::vector<Sample>& samples, std::optional<double> lock_extension,
                       std::optional<double> untangled_at);

}  // namespace knot_utm
