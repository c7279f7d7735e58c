#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "knot_utm/analysis/curve_readings.hpp"
#include "knot_utm/record/command.hpp"

namespace knot_utm {

/// Receives lines about what was read, which a user should see.
using Tell = std::function<void(const std::string& line)>;

struct Sample;

/// One row of curve.csv: what a testing machine records of a test.
struct CurveRow {
  double time = 0.0;       ///< [s]
  double extension = 0.0;  ///< s [m]; of a measured curve: what the machine calls its extension
  double load = 0.0;       ///< [N]
  double knot_distance = std::numeric_limits<double>::quiet_NaN();  ///< e [m]; NaN: there are no two knots
  double end_to_end = 0.0;                                          ///< L [m]; NaN: not known, as in a measured curve
  double load_lower = std::numeric_limits<double>::quiet_NaN();  ///< on the lower grip, balanced as `load` is [N]; NaN:
                                                                 ///< not known, as measured
  Phase phase = Phase::kIdle;
  /// since balance, on a compliant frame [m]; NaN: the frame is rigid, where it is s, or nothing but it is known
  double crosshead_travel = std::numeric_limits<double>::quiet_NaN();
  double balance_offset = 0.0;  ///< by which the true force is larger than both loads [N]
  PerKnot excess_length{};      ///< of each knot [m]; not a column of curve.csv
};

CurveRow curve_row(const Sample& sample);

/// Travel of the crosshead since balance [m].
double travel_of(const CurveRow& row);

/// False: loads over time alone, as the record of a load cell in a line.
bool has_travel(const std::vector<CurveRow>& rows);

/// Whether load and extension were zeroed between two rows. They were if L - s differs, since nothing else changes that
/// difference. Raw data have no L; they count as having one zero throughout.
bool balanced_between(const CurveRow& before, const CurveRow& after);

/// Which extension is meant: that of the specimen, s, or the travel of the crosshead. On a compliant frame they differ.
enum class ExtensionOf { kSpecimen, kMachine };

/// The pull of a test: the rows of phases that pull (pulls(phase)) whose extension is larger than in all of them
/// before. The row before the first of them is put in front as the origin, if its extension is smaller. If load and
/// extension were balanced between the two, the origin is s = 0 and F = 0. The force that the rod bears is taken from
/// the lower grip, whose true force is load_lower + balance_offset.
Pull pull_of(const std::vector<CurveRow>& rows, ExtensionOf extension = ExtensionOf::kSpecimen);
/// The excess lengths of the knots at the points of that pull.
HiddenRod hidden_rod_of(const std::vector<CurveRow>& rows, ExtensionOf extension = ExtensionOf::kSpecimen);

}  // namespace knot_utm
