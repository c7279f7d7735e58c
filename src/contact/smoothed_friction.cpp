#include "knot_utm/contact/smoothed_friction.hpp"

namespace knot_utm {

namespace {

constexpr double kLeastSlip = 1e-2;  // of the presliding displacement

}  // namespace

SmoothedFriction SmoothedFriction::of(const FrictionOptions& options, const FrictionScales& scales) {
  return {scales.coefficient, options.value("slip_tolerance").value_or(kPlainTolerance),
          kLeastSlip * scales.presliding * scales.radius};
}

}  // namespace knot_utm
