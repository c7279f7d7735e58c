#include "knot_utm/machine/breaking_laws.hpp"

#include "knot_utm/rod/stretching_laws.hpp"
#include "knot_utm/specimen/material.hpp"

namespace knot_utm {

TensionBreaking TensionBreaking::of(const Material& material) { return {*material.breaking_force}; }

FibreBreaking FibreBreaking::of(const Material& material) {
  const auto& keys = material.breaking;
  const double strain = strain_under(material, *material.breaking_force);
  return {strain, keys.number(kBendingShare), keys.number(kCrushingShare) * strain / *material.breaking_force,
          WeakestLink(keys.number(kWeibullModulus), keys.number(kTestedLength), keys.number(kWeakerShare))};
}

BreakingLaws breaking_law_of(const Material& material) { return BreakingRegistry::of(material.breaking.law, material); }

bool can_part(const Material& material) { return weakest(material).has_value(); }

bool parts_by_bending(const Material& material) {
  return material.breaking_force && std::visit([](const auto& law) { return law.kBends; }, breaking_law_of(material));
}

bool all_part_by_bending(const Material& material) {
  return parts_by_bending(material) && (!material.other || parts_by_bending(*material.other));
}

}  // namespace knot_utm
