#pragma once

#include <array>
#include <string>
#include <vector>

#include "knot_utm/io/csv.hpp"

/// The names of columns and units in exports of testing machines. This is data: a new name is a new entry.
namespace knot_utm {

struct RawUnit {
  const char* name;  ///< in lower case
  double si;         ///< one such unit in SI units
};

struct RawQuantity {
  const char* name;
  double CurveRow::*value;
  /// in lower case, UTF-8; of several names in one file the first in this list counts
  std::vector<std::string> names;
  std::vector<RawUnit> units;
  const char* allowed;  ///< list of the units, for messages
};

/// The three quantities: time, extension and load.
const std::array<RawQuantity, 3>& raw_quantities();

}  // namespace knot_utm
