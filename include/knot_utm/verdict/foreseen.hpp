#pragma once

#include <string>
#include <vector>

#include "knot_utm/method/method.hpp"

namespace knot_utm {

/// Warnings that are known of a method before anything is simulated, one line each.
std::vector<std::string> foreseen_warnings(const Method& method);

}  // namespace knot_utm
