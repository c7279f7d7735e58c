#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "knot_utm/analysis/curve_row.hpp"

namespace knot_utm {

/// Whether load and extension have been zeroed. A curve of knot_utm is balanced, which shows in its column of L. Raw
/// data of a testing machine have no L, nor do bags of measured readings.
bool has_its_zero(const std::vector<CurveRow>& rows);

/// Whether a quantity runs downwards in a record: it falls further below its first value than it rises above it.
bool falls(const std::vector<CurveRow>& rows, double CurveRow::*value);

/// The zero of raw data.
struct RawZero {
  double extension, load;    ///< recorded values, of the file's own readings [m], [N]
  double load_there = 0.0;   ///< load that takes the place of the recorded one [N]
  std::size_t first = 0;     ///< index of the reading with which the pull begins
  std::size_t readings = 1;  ///< number of readings at rest, of which the zero is the mean
};

/// Finds the zero as the state in which the crosshead begins to move. Let g be the largest growth of the extension in
/// the record. Among the readings before the extension has grown by g/100, the last one whose extension is not above
/// that of the first reading is the last reading at rest. Load and extension of the zero are the means of the
/// consecutive readings up to it whose extensions differ from it by at most g/1000. In a record that shows no rest, the
/// first reading is the zero, although the record may have been cut. Only rows that pull are used; there must be one.
///
/// A balanced load cell does not read exactly 0 N when the pull begins. If `other`, a pull with a zero, is given, the
/// raw data get its load at the zero (`load_there`), so that both curves begin in the same point. Otherwise they begin
/// at 0 N.
RawZero zero_at_rest(const std::vector<CurveRow>& rows, const Pull& other = {});

/// What was taken for zero, in words: "zero is 3.2 N at 0.0101 m, the mean of its 21 readings before the crosshead
/// moves".
std::string zero_words(const RawZero& zero);

/// The rows that pull, from the reading `zero.first` on, with the zero subtracted.
std::vector<CurveRow> balanced(const std::vector<CurveRow>& rows, const RawZero& zero);

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

/// What is read of a record over time alone, such as that of a load cell in a line, beside its peak and largest drop.
struct OverTime {
  double peak_time = 0.0;  ///< when the largest load is reached, from the first reading on [s]
  int slips = 0;           ///< falls of the load by more than a twentieth of that, before it
};

/// The readings of two pulls, both read by the same code (curve_readings.hpp), and the difference of their forces.
struct Comparison {
  CurveReadings a, b;
  std::optional<CurveDifference> difference;         ///< empty where they have no extension in common
  std::optional<GivenZeros> zeros;                   ///< empty where the curves were compared as they are
  std::optional<std::array<OverTime, 2>> over_time;  ///< of both where one has no travel: then there is no difference
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

/// The pulls of two curves and their comparison.
struct ComparedCurves {
  Pull a, b;
  Comparison comparison;
};

/// Compares two curves. Raw data of a testing machine contain only the travel of the crosshead; where one of the curves
/// is of that kind, the travel of the crosshead is used for both. Where one has no travel either, as the record of a
/// load cell in a line, loads are read over time alone, as they were recorded. `tell` receives one line for each
/// assumption that raw data make necessary.
ComparedCurves compare_curves(CurveOfFile a, CurveOfFile b, bool balances_raw_data, const Tell& tell);

}  // namespace knot_utm
