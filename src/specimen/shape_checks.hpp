#pragma once

#include <string>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

/// A length for a message, with four digits.
std::string text(double value);
/// A place for a message, "(1.2, 0.0, -3.0)".
std::string place_text(const Vec3& place);

/// Throw InvalidInput where a rod of this radius [m] cannot be drawn, or cannot be drawn with edges of this length [m].
void check_radius(double radius);
void check_edge_length(double edge_length, double radius);

/// Throws InvalidInput where the edges are too long for `specimen.length`.
void check_edges_of_length(const SpecimenOptions& specimen);

}  // namespace knot_utm
