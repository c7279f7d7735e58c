#pragma once

#include <string>

#include "knot_utm/io/method.hpp"

namespace knot_utm {

/// What of a method to change for a knot that came undone to stay tied: one line that names keys and their values.
std::string what_keeps_a_knot(const Method& method);

}  // namespace knot_utm
