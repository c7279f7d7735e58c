#pragma once

#include <string>

namespace knot_utm {

/// The names of columns that a user gives beside those that are known (raw_data.hpp). An empty one adds none.
struct RawColumns {
  std::string time, extension, load;
};

/// How tools take them.
constexpr const char* kColumnsOption = "--columns";
constexpr const char* kColumnsHelp =
    "names of the columns of raw data where they are not known: time=NAME,extension=NAME,load=NAME";

/// Reads "time=NAME,extension=NAME,load=NAME", in any order, not all of which need be there. A name may hold commas.
/// `key`: what the text was given as, for the message. Throws InvalidInput.
RawColumns parse_raw_columns(const std::string& text, const std::string& key);

}  // namespace knot_utm
