#pragma once

#include <string>
#include <vector>

#include "knot_utm/io/csv.hpp"
#include "knot_utm/io/raw_columns.hpp"

namespace knot_utm {

/// A curve as a text file: curve.csv or curve_full.csv (csv.hpp), else raw data of a testing machine (raw_data.hpp).
/// Throws InvalidInput.
std::vector<CurveRow> read_curve_file(const std::string& file, const RawColumns& columns = {});

/// The readings of a test that another one follows: from the one before the first that pulls (pulls(phase)), where that
/// begins, to the last that does, whatever their phases. Throws InvalidInput as read_curve_file, and, naming file and
/// reading, where a number is not finite, a time goes back, or a balance between them leaves two zeros of extension.
std::vector<CurveRow> read_course(const std::string& file, const RawColumns& columns = {});

}  // namespace knot_utm
