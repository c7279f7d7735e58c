#pragma once

#include <string>

namespace knot_utm {

/// A length as a message says it: four digits.
std::string text(double value);

/// Throw InvalidInput where a rod of this radius [m] cannot be drawn, or not with edges of this length [m].
void check_radius(double radius);
void check_edge_length(double edge_length, double radius);

}  // namespace knot_utm
