#include "knot_utm/rod/plastic_bending.hpp"

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/rod/material.hpp"

namespace knot_utm {

PlasticBending PlasticBending::of(const RodMaterial& material) {
  if (!material.yield_strain)
    throw InvalidInput::sentence(
        "material.yield_strain", "none",
        "material.yield_strain is missing: give the strain of the outermost fibre at which the "
        "rod yields, which bending_law: plastic needs");
  return {*material.yield_strain / material.radius, material.bending.number(kHardening)};
}

}  // namespace knot_utm
