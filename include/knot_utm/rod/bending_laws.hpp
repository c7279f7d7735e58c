#pragma once

#include <variant>

#include "knot_utm/numeric/law_registry.hpp"
#include "knot_utm/rod/elastic_bending.hpp"
#include "knot_utm/rod/plastic_bending.hpp"

namespace knot_utm {

/// All bending laws there are, in the order in which messages name them; the first is the default.
using BendingLaws = std::variant<ElasticBending, PlasticBending>;

inline constexpr auto kBendingLawNames = LawRegistry<BendingLaws>::kNames;

/// The law that a material names, with its parameters. Throws InvalidInput where one is missing.
BendingLaws bending_law_of(const Material& material);

/// Whether the law has an internal variable that changes from step to step. The rod then needs frames and
/// RodState::natural_curvature, be it zero.
bool remembers(const BendingLaws& law);
bool remembers_bends(const Material& material);

}  // namespace knot_utm
