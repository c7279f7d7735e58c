#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "knot_utm/analysis/curve_row.hpp"

/// The names of columns and units in exports of testing machines. This is data: a new name is a new entry.
namespace knot_utm {

struct RawQuantity {
  const char* name;
  double CurveRow::*value;
  std::vector<std::string> names;  ///< as written; of several in one file the first in this list counts
  std::size_t machines;            ///< from this one on the names say that it is the machine's own travel
  const char* allowed;             ///< the units, for messages
  std::unordered_map<std::string, std::size_t> ranks;  ///< place in `names` of each, by its folded text
  std::unordered_map<std::string, double> units;       ///< one such unit in SI units, by its folded text
};

/// The three quantities: time, extension and load.
const std::array<RawQuantity, 3>& raw_quantities();

/// One such unit in SI units; empty where it is not known. Units are spelt in upper or lower case, but for MN, which is
/// not mN.
std::optional<double> si_of(const RawQuantity& quantity, const std::string& unit);

}  // namespace knot_utm
