#pragma once

#include <variant>

#include "knot_utm/numeric/law_registry.hpp"
#include "knot_utm/rod/linear_twisting.hpp"

namespace knot_utm {

/// All twisting laws there are, in the order in which messages name them; the first is the default.
using TwistingLaws = std::variant<LinearTwisting>;

using TwistingRegistry = LawRegistry<TwistingLaws>;

}  // namespace knot_utm
