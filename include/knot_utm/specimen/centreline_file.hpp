#pragma once

#include <istream>
#include <string>

#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// Points of a CSV of x,y,z [m], one column a point. Up to two leading rows that are not numbers (names and units, as
/// final_shape.csv has them), empty rows and rows that begin with # are passed over.
/// Throws InvalidInput (key "specimen.file") where the file cannot be read, a row is not three numbers from -1000 to
/// 1000 m, two neighbours coincide, there are fewer than four points, or more rows than TextRows allows.
Points read_centreline(const std::string& file);
/// The same from a stream; `file` is its name in messages.
Points read_centreline(std::istream& in, const std::string& file);

}  // namespace knot_utm
