#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "knot_utm/analysis/curve_row.hpp"
#include "knot_utm/io/comparison.hpp"

namespace knot_utm {

/// A curve and what its file is called, by which it is spoken of.
struct CurveOfFile {
  std::string file;
  std::vector<CurveRow> rows;
};

/// What is to be done where raw data of a testing machine have no zero of load and extension.
struct ZeroWanted {
  bool balance = false;             ///< zero is where the crosshead begins to move (zero_at_rest)
  std::optional<double> begins_at;  ///< and of data that were cut, here the extension of their first reading [m]
};

/// The pulls of two curves, and what they are beside each other.
struct ComparedCurves {
  Pull a, b;
  Comparison comparison;
};

/// A machine knows the way of its crosshead alone: beside raw data that is what counts of a curve of ours, too.
/// `tell` is told in a line each what is assumed that raw data do not say. Throws InvalidInput where a reading of a
/// pull is not finite, a pull has less than two, a zero cannot be had, or the two have no extension in common.
ComparedCurves compare_curves(CurveOfFile a, CurveOfFile b, const ZeroWanted& zero,
                              const std::function<void(const std::string& line)>& tell);

}  // namespace knot_utm
