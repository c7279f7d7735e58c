#include "knot_utm/contact/power_friction.hpp"

namespace knot_utm {

PowerFriction PowerFriction::of(const FrictionOptions& options, const FrictionScales& scales) {
  return {scales.coefficient, scales.presliding * scales.radius, options.value("exponent").value_or(1.0),
          options.value("reference_pressure").value_or(1.0)};
}

}  // namespace knot_utm
