#pragma once

#include <string>

namespace knot_utm {

/// A length as a message says it: four digits.
std::string text(double value);

/// Two lengths, the first not above the second: four digits, and as many more as tell them apart.
std::string range_text(double low, double high);

/// Throw InvalidInput where a rod of this radius [m] cannot be drawn, or not with edges of this length [m].
void check_radius(double radius);
void check_edge_length(double edge_length, double radius);

}  // namespace knot_utm
