#pragma once

#include <optional>
#include <string>
#include <vector>

#include "knot_utm/analysis/curve_row.hpp"
#include "knot_utm/raw/comparison.hpp"
#include "knot_utm/raw/raw_options.hpp"

namespace knot_utm {

/// A curve, and the name of its file as messages give it.
struct CurveOfFile {
  std::string file;
  std::vector<CurveRow> rows;
};

/// How to find the zero of raw data. A curve of ours keeps its own.
struct ZeroWanted {
  /// Whether the zero is the state in which the crosshead begins to move (zero_at_rest); empty: of raw data it is.
  std::optional<bool> balance;
  std::optional<double> begins_at;  ///< for a record whose beginning was cut off: extension of its first reading [m]
};

/// The pulls of two curves and their comparison.
struct ComparedCurves {
  Pull a, b;
  Comparison comparison;
};

/// Compares two curves. Raw data of a testing machine contain only the travel of the crosshead; where one of the curves
/// is of that kind, the travel of the crosshead is used for both. `tell` receives one line for each assumption that raw
/// data make necessary. Throws InvalidInput where a reading of a pull is not finite, a pull has fewer than two
/// readings, a zero cannot be found, or the two have no extension in common.
ComparedCurves compare_curves(CurveOfFile a, CurveOfFile b, const ZeroWanted& zero, const Tell& tell);

}  // namespace knot_utm
