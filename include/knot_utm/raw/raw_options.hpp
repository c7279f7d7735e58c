#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "knot_utm/analysis/curve_row.hpp"
#include "knot_utm/record/loading_steps.hpp"

namespace knot_utm {

/// A text for time, extension and load; empty where nothing is said of it.
using RawColumns = std::array<std::string, 3>;

/// How options are given, for messages: "--units load=N" to a command, "units:=load=N" to a launch, and
/// "program.0.follow.units: load=N" in a method.
struct RawSpelling {
  std::string before = "--", between = " ";
  bool invert_is_flag = true;  ///< "--invert" and "--invert=load"; otherwise it is spelt as the others are

  std::string option(const std::string& name) const { return before + name; }
  std::string option(const std::string& name, const std::string& value) const {
    return before + name + between + value;
  }
  std::string invert(const std::string& what) const;  ///< empty: what falls
};

/// What a user says about raw data of a testing machine.
struct RawOptions {
  RawColumns columns = {};  ///< names of columns beside the known ones, or their numbers, from 1
  RawColumns units = {};    ///< units of the columns; they count for more than those of the file
  int specimen = 0;         ///< which one of several in one file, from 1; 0: there must be only one
  std::string invert = {};  ///< whose sign is turned: falling (what falls), extension, load or both; empty: none
  bool needs_time = true;   ///< otherwise a file without a column of time has NaN for it
  RawSpelling spelling = {};
};

/// Receives lines about what was read, which a user should see.
using Tell = std::function<void(const std::string& line)>;

/// Reads "time=NAME,extension=NAME,load=NAME". The parts may be in any order, and some may be missing. A name may
/// contain commas. `key`: the option or key from which the text comes, for the message. Throws InvalidInput.
RawColumns parse_raw_columns(const std::string& text, const std::string& key);

/// Which of the words change nothing where the curve is one of ours, such as "--units and --specimen change nothing".
/// Empty where none is given. `one_of_many`: a specimen was chosen from a batch or a bag, which that word does change.
std::string without_effect(const RecordWords& words, const RawSpelling& spelling, bool one_of_many);

/// What the words mean for the file number `file` of `files`. Throws InvalidInput.
RawOptions raw_options(const RecordWords& words, const RawSpelling& spelling = {}, std::size_t file = 0,
                       std::size_t files = 1);

/// Whether a quantity runs downwards in a record: it falls further below its first value than it rises above it.
bool falls(const std::vector<CurveRow>& rows, double CurveRow::*value);

/// Turns the signs that are asked for. `tell` receives a line on what was turned, or on what falls where nothing is
/// asked for. `file`: name of the file in messages.
void turn_signs(std::vector<CurveRow>& rows, const RawOptions& options, const std::string& file, const Tell& tell);

}  // namespace knot_utm
