#pragma once

#include <cstddef>
#include <string>

#include "knot_utm/numeric/law_keys.hpp"

namespace knot_utm {

/// Number of a friction law in the registry (friction.hpp).
enum class FrictionLaw : std::size_t {};

/// By its name as in a method, which must be one of kFrictionLawNames (friction.hpp).
FrictionLaw law_named(const std::string& name);

/// `physics.friction` of a method.
using FrictionOptions = LawOptions<FrictionLaw>;

}  // namespace knot_utm
