#include "knot_utm/machine/straight_strength.hpp"

#include <algorithm>

#include "knot_utm/rod/stretching_laws.hpp"
#include "knot_utm/specimen/material.hpp"

namespace knot_utm {

std::optional<double> straight_strength(const Material& material) {
  if (!material.breaking_strain) return material.breaking_force;
  const StretchedEdge edge{material.stretching_stiffness, 1.0, 1.0 + *material.breaking_strain};
  const double tension =
      std::visit([&](const auto& law) { return law.respond(edge).tension; }, stretching_law_of(material));
  return std::min(tension, material.breaking_force.value_or(tension));
}

}  // namespace knot_utm
