#include "knot_utm/contact/stribeck_friction.hpp"

namespace knot_utm {

StribeckFriction StribeckFriction::of(const FrictionOptions& options, const FrictionScales& scales) {
  return {scales.coefficient, scales.presliding * scales.radius, options.value("kinetic_share").value_or(1.0),
          options.value("slip_length").value_or(1.0) * scales.radius};
}

FrictionMemory StribeckFriction::remember(const FrictionInput<Vec3>& in, const Vec3& z) const {
  const Cone cone(*this, in.slip.norm() / presliding, in.own);
  const double slid = cone.size < cone.bears ? 0.0 : in.own + presliding * (cone.size - cone.bears);
  return {presliding * cone.bears * z, slid};
}

}  // namespace knot_utm
