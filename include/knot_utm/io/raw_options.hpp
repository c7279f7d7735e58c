#pragma once

#include <functional>
#include <string>
#include <vector>

#include "knot_utm/analysis/curve_row.hpp"

namespace knot_utm {

/// A text for each quantity; empty where nothing is said of it.
struct RawColumns {
  std::string time, extension, load;
};

/// Whose sign is turned.
enum class Invert { kNothing, kWhatFalls, kExtension, kLoad, kBoth };

/// What a user says about raw data of a testing machine.
struct RawOptions {
  RawColumns columns = {};           ///< names of columns beside the known ones, or their numbers, from 1
  RawColumns units = {};             ///< units of the columns; they count for more than those of the file
  int specimen = 0;                  ///< which one of several in one file, from 1; 0: there must be only one
  Invert invert = Invert::kNothing;  ///< the sign of what is turned
  bool needs_time = true;            ///< otherwise a file without a column of time has NaN for it
};

/// Receives lines about what was read, which a user should see.
using Tell = std::function<void(const std::string& line)>;

/// The options of the tools, and their help texts.
constexpr const char* kColumnsOption = "--columns";
constexpr const char* kColumnsHelp =
    "columns of raw data by name or number: time=NAME,extension=NAME,load=NAME, or one or two of these";
constexpr const char* kUnitsOption = "--units";
constexpr const char* kUnitsHelp = "units of raw data: time=s,extension=in,load=lbf, or one or two of these";
constexpr const char* kSpecimenOption = "--specimen";
constexpr const char* kInvertOption = "--invert";
constexpr const char* kInvertHelp =
    "turn the sign of what falls in the pull, or, as --invert=load, --invert=extension or --invert=both, of these";

/// Reads "time=NAME,extension=NAME,load=NAME". The parts may be in any order, and some may be missing. A name may
/// contain commas. `key`: the option or key from which the text comes, for the message. Throws InvalidInput.
RawColumns parse_raw_columns(const std::string& text, const std::string& key);

/// Reads "falling", "extension", "load" or "both". Throws InvalidInput.
Invert parse_invert(const std::string& text);

/// Which of extension and load run downwards in a record: they fall further below their first value than they rise
/// above it.
struct Falling {
  bool extension, load;
};
Falling what_falls(const std::vector<CurveRow>& rows);

/// Turns the signs that are asked for. `tell` receives a line on what was turned, or on what falls where nothing is
/// asked for. `file`: name of the file in messages.
void turn_signs(std::vector<CurveRow>& rows, Invert invert, const std::string& file, const Tell& tell);

}  // namespace knot_utm
