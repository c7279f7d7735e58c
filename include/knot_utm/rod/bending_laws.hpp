#pragma once

#include <variant>

#include "knot_utm/numeric/law_registry.hpp"
#include "knot_utm/rod/elastic_bending.hpp"
#include "knot_utm/rod/frictional_bending.hpp"
#include "knot_utm/rod/material.hpp"
#include "knot_utm/rod/plastic_bending.hpp"

namespace knot_utm {

/// All bending laws there are, in the order in which messages name them; the first is the default.
using BendingLaws = std::variant<ElasticBending, PlasticBending, FrictionalBending>;

using BendingRegistry = LawRegistry<BendingLaws>;

/// The law that a material names, with its parameters.
inline BendingLaws bending_law_of(const RodMaterial& material) {
  return BendingRegistry::of(material.bending.law, material);
}

/// Whether the rod bends by this law and not by the elastic one, which a rod without natural curvature has in a form of
/// its own (isotropic_bending.hpp). The rod then needs frames and RodState::natural_curvature, be it zero.
inline bool bends_on_frames(const BendingLaws& law) { return !std::holds_alternative<ElasticBending>(law); }
inline bool bends_on_frames(const RodMaterial& material) { return bends_on_frames(bending_law_of(material)); }

/// Whether the law has an internal variable that changes from step to step. A natural curvature then does not stay.
inline bool remembers(const BendingLaws& law) {
  return std::visit([](const auto& of) { return of.kRemembers; }, law);
}
inline bool remembers_bends(const RodMaterial& material) { return remembers(bending_law_of(material)); }

/// How many numbers it remembers of a node besides the natural curvature.
inline int own_numbers(const BendingLaws& law) {
  return std::visit([](const auto& of) { return of.kOwn; }, law);
}

}  // namespace knot_utm
