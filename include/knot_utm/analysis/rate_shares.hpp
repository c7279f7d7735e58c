#pragma once

#include <optional>
#include <vector>

#include "knot_utm/machine/sample.hpp"

namespace knot_utm {

/// How far a pull is from a slow one, whose forces know no time. Over the pull up to the lock, else to its end or to
/// the rod's break; from every accepted step.
struct RateShares {
  /// Work that went into drag over the work of the grips: where knots slide steadily, the share of drag in F [-].
  std::optional<double> drag;
  /// Mean over time of |d - mean of d| over the mean of F, d the upper less the lower force. Weight and steady drag are
  /// in the mean of d; what is left is mass that gains or loses speed [-].
  std::optional<double> inertia;
};

RateShares rate_shares(const std::vector<Sample>& samples, std::optional<double> lock_extension);

}  // namespace knot_utm
