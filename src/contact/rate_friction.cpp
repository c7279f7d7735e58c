#include "knot_utm/contact/rate_friction.hpp"

namespace knot_utm {

RateFriction RateFriction::of(const FrictionOptions& options, const FrictionScales& scales) {
  return {scales.coefficient, scales.presliding * scales.radius, options.value("rate").value_or(0.0),
          options.value("rate_speed").value_or(1.0)};
}

FrictionMemory RateFriction::remember(const FrictionInput<Vec3>& in, const Vec3& z) const {
  const Spring spring(*this, in.slip.norm() / presliding, in.dt);
  return {presliding * spring.cone() * z, 0.0};
}

}  // namespace knot_utm
