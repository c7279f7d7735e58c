#pragma once

#include <cstddef>

#include "knot_utm/numeric/law_registry.hpp"

namespace knot_utm {

/// Number of a friction law in the registry (friction.hpp).
enum class FrictionLaw : std::size_t {};

/// `physics.friction` of a method.
using FrictionOptions = LawOptions<FrictionLaw>;

}  // namespace knot_utm
