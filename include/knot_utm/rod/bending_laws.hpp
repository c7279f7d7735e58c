#pragma once

#include <variant>

#include "knot_utm/numeric/law_registry.hpp"
#include "knot_utm/rod/elastic_bending.hpp"
#include "knot_utm/rod/frictional_bending.hpp"
#include "knot_utm/rod/plastic_bending.hpp"
#include "knot_utm/rod/viscoelastic_bending.hpp"

namespace knot_utm {

/// All bending laws there are, in the order in which messages name them; the first is the default.
using BendingLaws = std::variant<ElasticBending, PlasticBending, FrictionalBending, ViscoelasticBending>;

using BendingRegistry = LawRegistry<BendingLaws>;

/// The law that a material names, with its parameters. Throws InvalidInput where one is missing.
BendingLaws bending_law_of(const RodMaterial& material);

/// Whether the rod bends by this law and not by the elastic one, which a rod without natural curvature has in a form of
/// its own (isotropic_bending.hpp). The rod then needs frames and RodState::natural_curvature, be it zero.
bool bends_on_frames(const BendingLaws& law);
bool bends_on_frames(const RodMaterial& material);

/// Whether the law has an internal variable that changes from step to step.
bool remembers(const BendingLaws& law);
bool remembers_bends(const RodMaterial& material);

/// Whether a natural curvature that the rod has stays as it is.
bool keeps_natural_curvature(const RodMaterial& material);

/// How many numbers it remembers of a node besides the natural curvature.
int own_numbers(const BendingLaws& law);

}  // namespace knot_utm
