#pragma once

#include <variant>

#include "knot_utm/contact/normal_law.hpp"
#include "knot_utm/numeric/law_registry.hpp"

namespace knot_utm {

/// All pressure laws there are, in the order in which messages name them; the first is the default. Contacts along
/// smooth centrelines and on rollers use one of them.
using PressureLaws = std::variant<NormalLaw>;

using PressureRegistry = LawRegistry<PressureLaws>;

inline double begin_of(const PressureLaws& law) {
  return std::visit([](const auto& own) { return own.begin(); }, law);
}

/// e(D) [N]
inline double energy_of(const PressureLaws& law, double overlap) {
  return std::visit([&](const auto& own) { return own.energy(overlap); }, law);
}

}  // namespace knot_utm
