#include "knot_utm/contact/smoothed_friction.hpp"

namespace knot_utm {

namespace {

// The least slip over which friction turns, as a fraction of the presliding displacement. With a hundredth of it
// strands that whip at m/s in steps of microseconds took 15 iterations a step, and three draws of the stability matrix
// went nowhere.
constexpr double kLeastSlip = 1e-1;

}  // namespace

SmoothedFriction SmoothedFriction::of(const FrictionOptions& options, const FrictionScales& scales) {
  return {scales.coefficient, options.value("slip_tolerance").value_or(kPlainTolerance),
          kLeastSlip * scales.presliding * scales.radius};
}

}  // namespace knot_utm
