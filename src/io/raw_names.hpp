#pragma once

#include <array>
#include <string>
#include <vector>

#include "knot_utm/io/csv.hpp"

/// What exports of testing machines call their columns and units: data, to be lengthened by a row.
namespace knot_utm {

struct RawUnit {
  const char* name;  ///< in lower case
  double si;
};

struct RawQuantity {
  const char* name;
  double CurveRow::*value;
  std::vector<std::string> names;  ///< in lower case, UTF-8; of several in one file the first counts
  std::vector<RawUnit> units;
  const char* allowed;  ///< units, for the message
};

/// Time, extension and load.
const std::array<RawQuantity, 3>& raw_quantities();

}  // namespace knot_utm
