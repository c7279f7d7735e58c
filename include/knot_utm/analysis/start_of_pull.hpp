#pragma once

#include <cmath>
#include <optional>
#include <vector>

namespace knot_utm {

struct Sample;

/// True forces on both grips at one time [N].
struct GripForces {
  double upper, lower;

  double difference() const { return std::abs(upper - lower); }
};

/// The forces on the grips where they differ most, from the sample before the first pull over its first hundredth. At
/// rest both are the same, apart from the rod's weight. They differ while the specimen still moves, and where the pull
/// sets it moving by a jerk. Empty: nothing was pulled.
std::optional<GripForces> forces_at_start(const std::vector<Sample>& samples);

}  // namespace knot_utm
