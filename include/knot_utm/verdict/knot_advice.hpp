#pragma once

#include <string>

#include "knot_utm/method/method.hpp"

namespace knot_utm {

/// Advice for a knot that came undone: which values of the method to change so that it stays tied. One line that names
/// the keys and their values.
std::string what_keeps_a_knot(const Method& method);

}  // namespace knot_utm
