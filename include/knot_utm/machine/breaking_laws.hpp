#pragma once

#include <variant>

#include "knot_utm/machine/fibre_breaking.hpp"
#include "knot_utm/machine/tension_breaking.hpp"
#include "knot_utm/numeric/law_registry.hpp"

namespace knot_utm {

/// All breaking laws there are, in the order in which messages name them; the first is the default.
using BreakingLaws = std::variant<TensionBreaking, FibreBreaking>;

using BreakingRegistry = LawRegistry<BreakingLaws>;

/// The law that a material with a breaking force names.
BreakingLaws breaking_law_of(const Material& material);

bool can_part(const Material& material);  ///< it has a breaking force, or that of another rope has one

/// Whether the bend of a rope of this material helps to part it, so that a knot costs strength.
bool parts_by_bending(const Material& material);
/// The same of every rope of the rod: else the strength of a knot may be that of a straight rope, which was given.
bool all_part_by_bending(const Material& material);

}  // namespace knot_utm
