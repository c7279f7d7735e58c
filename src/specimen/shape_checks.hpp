#pragma once

#include <string>

#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

/// A length as a message says it: four digits.
std::string text(double value);

/// Two lengths, the first not above the second: four digits, and as many more as tell them apart.
std::string range_text(double low, double high);

/// Throw InvalidInput where a rod of this radius [m] cannot be drawn, or not with edges of this length [m].
void check_radius(double radius);
void check_edge_length(double edge_length, double radius);

/// Throws InvalidInput where edges are too long for `specimen.length`.
void check_edges_of_length(const SpecimenOptions& specimen);

}  // namespace knot_utm
