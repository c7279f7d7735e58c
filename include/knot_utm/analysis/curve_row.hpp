#pragma once

#include <vector>

#include "knot_utm/analysis/curve_readings.hpp"
#include "knot_utm/record/program.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {

/// One row of curve.csv: what a testing machine records of a test.
struct CurveRow {
  double time = 0.0;                     ///< [s]
  double extension = 0.0;                ///< as the crosshead travels since balance: s where the frame is rigid [m]
  double load = 0.0;                     ///< [N]
  double knot_distance = Sample::kNone;  ///< e [m]; NaN: no two knots
  double end_to_end = 0.0;               ///< L [m]; NaN: not known, of a measured curve
  double load_lower = Sample::kNone;     ///< [N]; NaN: not known, of a measured curve
  Phase phase = Phase::kIdle;
  double corrected_extension = Sample::kNone;  ///< s where the frame is compliant [m]; NaN: it is rigid, or not known
  PerKnot excess_length{};                     ///< in each knot [m]; curve.csv has none
};

CurveRow curve_row(const Sample& sample);

/// Whether load and extension were zeroed between two rows: L less s, which nothing else changes, differs. Raw data
/// have no L, and one zero.
bool balanced_between(const CurveRow& before, const CurveRow& after);

/// On a compliant frame the crosshead's extension is not the specimen's.
enum class ExtensionOf { kSpecimen, kMachine };

/// The rows in which the specimen is pulled (pulls(phase)) that reach a new largest extension. Before them, as their
/// origin, stands the row before the first of them, as a rule that of the balance. Where a balance lies between the
/// two, the origin is s = 0 and F = 0, as it makes them. The lower grip, which nothing balances, tells what the rod
/// bears.
Pull pull_of(const std::vector<CurveRow>& rows, ExtensionOf extension = ExtensionOf::kSpecimen);
/// The rod hidden in the knots at the points of that pull.
HiddenRod hidden_rod_of(const std::vector<CurveRow>& rows, ExtensionOf extension = ExtensionOf::kSpecimen);

}  // namespace knot_utm
