#pragma once

#include <variant>

#include "knot_utm/breaking/fibre_breaking.hpp"
#include "knot_utm/breaking/tension_breaking.hpp"
#include "knot_utm/numeric/law_registry.hpp"
#include "knot_utm/specimen/material.hpp"

namespace knot_utm {

/// All breaking laws there are, in the order in which messages name them; the first is the default.
using BreakingLaws = std::variant<TensionBreaking, FibreBreaking>;

using BreakingRegistry = LawRegistry<BreakingLaws>;

/// The law that a material with a breaking force names.
inline BreakingLaws breaking_law_of(const Material& material) {
  return BreakingRegistry::of(material.breaking.law, material);
}

/// It has a breaking force, or that of another rope has one.
inline bool can_part(const Material& material) { return weakest(material).has_value(); }

/// Whether the bend of a rope of this material helps to part it, so that a knot costs strength.
inline bool parts_by_bending(const Material& material) {
  return material.breaking_force && std::visit([](const auto& law) { return law.kBends; }, breaking_law_of(material));
}
/// The same of every rope of the rod: else the strength of a knot may be that of a straight rope, which was given.
inline bool all_part_by_bending(const Material& material) {
  return parts_by_bending(material) && (!material.other || parts_by_bending(*material.other));
}

}  // namespace knot_utm
