#pragma once

#include <optional>
#include <vector>

#include "knot_utm/machine/sample.hpp"

namespace knot_utm {

/// How far a pull is from a slow one, whose forces know no time. Over the pull up to the lock, else to where the knot
/// comes undone, the rod parts or the pull ends; from every accepted step.
struct RateShares {
  /// What goes into drag on a way, over that way and the mean of F: half of the way has less, half has more. The energy
  /// of jumps, which drag takes up too, is on little of the way [-].
  std::optional<double> drag;
  /// Mean over time of |d - mean of d| over the mean of F, d the upper less the lower force. Weight and steady drag are
  /// in the mean of d; what is left is mass that gains or loses speed [-].
  std::optional<double> inertia;
};

RateShares rate_shares(const std::vector<Sample>& samples, std::optional<double> lock_extension,
                       std::optional<double> untangled_at);

}  // namespace knot_utm
