#pragma once

#include <optional>
#include <string>
#include <vector>

#include "knot_utm/numeric/tell.hpp"
#include "knot_utm/run/csv.hpp"

namespace knot_utm {

/// The curve of the run in a folder, or of a specimen of the batch there. `specimen`: its number, which --specimen has,
/// 0: none is given; empty: none can be given. What is no folder is the file itself. Throws InvalidInput.
std::string curve_file_of(const std::string& given, std::optional<int> specimen = std::nullopt);

/// Whether a file is a curve.csv or curve_full.csv, by the row of its names: what a testing machine exports has no
/// phases. Throws InvalidInput where it cannot be read.
bool is_curve_file(const std::string& file);

/// Reads the readings of a test whose crosshead motion another test follows. They begin with the reading before the
/// first that pulls (pulls(phase)) and end with the record, or where it was balanced behind the last that pulls, which
/// `tell` receives. Throws InvalidInput where the file is no curve.csv. It also throws, naming file and reading,
/// where a number is not finite, a time is smaller than the one before, or a balance before the last that pulls makes
/// two zeros of extension.
std::vector<CurveRow> read_course(const std::string& file, const Tell& tell = nullptr);

}  // namespace knot_utm
