#pragma once

#include <optional>
#include <vector>

#include "knot_utm/analysis/curve_row.hpp"

namespace knot_utm {

/// A curve of ours is balanced and has its zero of extension: it knows L. Raw data of a testing machine do not, nor do
/// bags of measured readings.
bool has_its_zero(const std::vector<CurveRow>& rows);

/// Where raw data are zero.
struct RawZero {
  double extension, load;    ///< as recorded [m], [N]
  std::size_t first = 0;     ///< reading that the pull begins with
  std::size_t readings = 1;  ///< at rest, of which these are the means
};

/// Zero is where the crosshead begins to move: of the readings before the extension has grown by a hundredth of all its
/// growth, the last one that lies no further out than the first one. Load and extension are the means of the readings
/// in a row up to it that lie within a thousandth of the growth. A record that shows no rest has but its first reading:
/// it counts as zero, though the record may have been cut. Only rows that pull count; there must be one.
///
/// A cell that was balanced does not read exactly 0 N when the pull begins. `other`: a pull that has its zero; there
/// the raw data get the load that it has, so that both begin in the same point. Empty: 0 N.
RawZero zero_at_rest(const std::vector<CurveRow>& rows, const Pull& other = {});

/// Of a record that was cut where the extension was `begins_at` beyond zero: its load there is told by another pull
/// that has its zero, so that both agree in that point. None where the other pull does not reach there.
std::optional<RawZero> zero_of_cut(const std::vector<CurveRow>& rows, double begins_at, const Pull& other);

/// The rows that pull, from the reading of the zero on, less the zero.
std::vector<CurveRow> balanced(const std::vector<CurveRow>& rows, const RawZero& zero);

}  // namespace knot_utm
