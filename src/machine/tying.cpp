#include "knot_utm/machine/tying.hpp"

#include <algorithm>

#include "knot_utm/machine/end_tying.hpp"
#include "knot_utm/machine/tied_loop.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/specimen/scales.hpp"

namespace knot_utm {

std::unique_ptr<Tying> make_tying(const SpecimenOptions& specimen, const Material& material,
                                  const Centreline& centreline, double creep_speed, TimeStep& stepper, Grips& grips) {
  if (knot_of(specimen).about().loop)
    return std::make_unique<TiedLoop>(specimen, material, centreline, creep_speed, stepper, grips);
  if (!specimen.to_be_tied) return nullptr;
  const double rest_speed = std::max(specimen_scales(material).rest_speed, creep_speed);
  return std::make_unique<EndTying>(centreline, material, tying_load(specimen, material), rest_speed, stepper, grips);
}

}  // namespace knot_utm
