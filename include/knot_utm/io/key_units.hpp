#pragma once

#include <string>

#include "knot_utm/io/method.hpp"

namespace knot_utm {

/// The unit of the number at a dotted key of the method, as overrides name it: "m/s" for "program.pull.speed". Empty
/// where the method has no number of that name.
std::string unit_of_key(const Method& method, const std::string& key);

}  // namespace knot_utm
