#pragma once

#include <string>
#include <vector>

#include "knot_utm/raw/raw_options.hpp"
#include "knot_utm/run/csv.hpp"

namespace knot_utm {

/// The curve of the run in a folder, or of that specimen of the batch there which `options` choose. What is no folder
/// is the file itself. Throws InvalidInput.
std::string curve_file_of(const std::string& given, const RawOptions& options = {});

/// Reads a curve from a text file: curve.csv or curve_full.csv (csv.hpp), also as a spreadsheet saves it anew, or else
/// raw data of a testing machine (raw_data.hpp). `tell` receives what raw data were read, and that a spreadsheet saved
/// a curve. Throws InvalidInput.
std::vector<CurveRow> read_curve_file(const std::string& file, const RawOptions& options = {},
                                      const Tell& tell = nullptr);

/// Reads the readings of a test whose crosshead motion another test follows. They begin with the reading before the
/// first that pulls (pulls(phase)) and end with the record, or where it was balanced behind the last that pulls, which
/// `tell` receives. Throws InvalidInput as read_curve_file does. It also throws, naming file and reading, where a
/// number is not finite, a time is smaller than the one before, or a balance before the last that pulls makes two zeros
/// of extension.
std::vector<CurveRow> read_course(const std::string& file, const RawOptions& options = {}, const Tell& tell = nullptr);

}  // namespace knot_utm
