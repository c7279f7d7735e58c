#include "knot_utm/rod/frictional_bending.hpp"

#include "knot_utm/rod/material.hpp"

namespace knot_utm {

FrictionalBending FrictionalBending::of(const RodMaterial& material) {
  FrictionalBending out;
  out.stick_ratio = material.bending.number(kStickRatio);
  out.curvature = material.bending.number(kFrictionMoment) / material.radius;
  out.by_tension = material.bending.number(kCompaction) * material.radius / material.bending_stiffness;
  return out;
}

}  // namespace knot_utm
