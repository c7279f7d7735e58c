#pragma once

#include <string>

namespace knot_utm {

/// Names of columns that the user gives in addition to the known ones (raw_data.hpp). Empty: none is added.
struct RawColumns {
  std::string time, extension, load;
};

/// The command-line option of the tools for these names, and its help text.
constexpr const char* kColumnsOption = "--columns";
constexpr const char* kColumnsHelp =
    "names of the columns of raw data where they are not known: time=NAME,extension=NAME,load=NAME";

/// Reads "time=NAME,extension=NAME,load=NAME". The parts may be in any order, and some may be missing. A name may
/// contain commas. `key`: the option or key from which the text comes, for the message. Throws InvalidInput.
RawColumns parse_raw_columns(const std::string& text, const std::string& key);

}  // namespace knot_utm
