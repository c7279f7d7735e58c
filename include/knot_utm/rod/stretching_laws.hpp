#pragma once

#include <variant>

#include "knot_utm/numeric/law_registry.hpp"
#include "knot_utm/rod/linear_stretching.hpp"
#include "knot_utm/rod/material.hpp"
#include "knot_utm/rod/neo_hookean_stretching.hpp"

namespace knot_utm {

/// All stretching laws there are, in the order in which messages name them; the first is the default.
using StretchingLaws = std::variant<LinearStretching, NeoHookeanStretching>;

using StretchingRegistry = LawRegistry<StretchingLaws>;

/// The law that a material names, with its parameters.
inline StretchingLaws stretching_law_of(const RodMaterial& material) {
  return StretchingRegistry::of(material.stretching.law, material);
}

/// Strain lambda - 1 of a straight rod of this material that bears a tension [N] of 0 or more.
inline double strain_under(const RodMaterial& material, double tension) {
  return std::visit([&](const auto& law) { return law.strain(material.stretching_stiffness, tension); },
                    stretching_law_of(material));
}

}  // namespace knot_utm
