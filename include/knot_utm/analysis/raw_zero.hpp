#pragma once

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

/// Finds the zero of a record whose beginning was cut off, up to an extension of `begins_at` [m]. The load there is
/// taken from another pull, which has its zero, so that both agree in that point. Empty where the other pull does not
/// contain that extension.
std::optional<RawZero> zero_of_cut(const std::vector<CurveRow>& rows, double begins_at, const Pull& other);

/// What was taken for zero, in words: "zero is 3.2 N at 0.0101 m, the mean of its 21 readings before the crosshead
/// moves".
std::string zero_words(const RawZero& zero);

/// The rows that pull, from the reading `zero.first` on, with the zero subtracted.
std::vector<CurveRow> balanced(const std::vector<CurveRow>& rows, const RawZero& zero);

}  // namespace knot_utm
