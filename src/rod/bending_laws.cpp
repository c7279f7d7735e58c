#include "knot_utm/rod/bending_laws.hpp"

#include "knot_utm/rod/material.hpp"

namespace knot_utm {

BendingLaws bending_law_of(const RodMaterial& material) { return BendingRegistry::of(material.bending.law, material); }

bool bends_on_frames(const BendingLaws& law) { return !std::holds_alternative<ElasticBending>(law); }

bool bends_on_frames(const RodMaterial& material) { return bends_on_frames(bending_law_of(material)); }

bool remembers(const BendingLaws& law) {
  return std::visit([](const auto& of) { return of.kRemembers; }, law);
}

int own_numbers(const BendingLaws& law) {
  return std::visit([](const auto& of) { return of.kOwn; }, law);
}

bool keeps_natural_curvature(const RodMaterial& material) {
  return std::visit([](const auto& of) { return of.kKeepsNatural; }, bending_law_of(material));
}

bool remembers_bends(const RodMaterial& material) { return remembers(bending_law_of(material)); }

}  // namespace knot_utm
