#pragma once

#include <optional>
#include <string>
#include <vector>

#include "knot_utm/analysis/curve_row.hpp"
#include "knot_utm/analysis/raw_zero.hpp"
#include "knot_utm/numeric/tell.hpp"

namespace knot_utm {

/// The difference F_b - F_a of two pulls over the extensions that both of them cover. Between two points of a pull the
/// force is interpolated linearly.
struct CurveDifference {
  Range common{0.0, 0.0};   ///< extensions that both pulls cover [m]
  double rms = 0.0;         ///< root mean square of the difference over these extensions [N]
  double largest = 0.0;     ///< the difference of largest size, with its sign [N]
  double largest_at = 0.0;  ///< extension at which it occurs [m]
  double load = 0.0;        ///< largest |F_a| over these extensions, the reference for relative differences [N]
};

/// Empty where the pulls have no extension in common, or where one of them has fewer than two points.
std::optional<CurveDifference> curve_difference(const Pull& a, const Pull& b);

/// The zeros that the curves were given. Empty: the curve has its own.
struct GivenZeros {
  std::optional<RawZero> a, b;
};

/// The readings of two pulls, both read by the same code (curve_readings.hpp), and the difference of their forces.
struct Comparison {
  CurveReadings a, b;
  std::optional<CurveDifference> difference;  ///< empty where they have no extension in common
  std::optional<GivenZeros> zeros;            ///< empty where the curves were compared as they are
};

Comparison compare(const Pull& a, const Pull& b);

/// The comparison as YAML. For each reading it gives that of A, that of B, B - A, and (B - A)/A; null stands for what
/// does not exist.
std::string comparison_yaml(const Comparison& comparison, const std::string& file_a, const std::string& file_b);

/// One line for each value that exceeds a relative tolerance. The values are the RMS difference of the forces, over A's
/// largest load in the common range, and the difference of each reading, over that of A. A reading that only one of the
/// two has exceeds every tolerance.
std::vector<std::string> beyond_tolerance(const Comparison& comparison, double tolerance);

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
