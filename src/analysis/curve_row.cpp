#include "knot_utm/analysis/curve_row.hpp"

#include <cmath>

namespace knot_utm {
namespace {

double own_extension(const CurveRow& row) {
  return std::isfinite(row.corrected_extension) ? row.corrected_extension : row.extension;
}

constexpr double kSameZero = 1e-9;  // far above rounding, far below what anybody measures [m]

PullPoint point_of(const CurveRow& row, ExtensionOf extension) {
  const double s = extension == ExtensionOf::kMachine ? row.extension : own_extension(row);
  PullPoint point{row.time, s, row.knot_distance, row.load};
  point.borne = row.load_lower;
  point.excess_length = row.excess_length;
  return point;
}

/// From where the pull began. Nothing balances the force on the lower grip.
PullPoint origin_of(const CurveRow& before, const CurveRow& first, ExtensionOf extension) {
  PullPoint origin = point_of(before, extension);
  if (balanced_between(before, first)) origin.extension = origin.force = 0.0;
  return origin;
}

}  // namespace

CurveRow curve_row(const Sample& sample) {
  CurveRow row;
  row.time = sample.time;
  row.extension = sample.extension;
  if (!std::isnan(sample.raw_extension)) {
    row.extension = sample.raw_extension;
    row.corrected_extension = sample.extension;
  }
  row.load = sample.load;
  row.knot_distance = sample.knot_distance;
  row.end_to_end = sample.end_to_end;
  row.load_lower = sample.force_lower;
  row.phase = sample.phase;
  row.excess_length = {sample.excess_length[0], sample.excess_length[1]};
  return row;
}

bool balanced_between(const CurveRow& before, const CurveRow& after) {
  const double zero_before = before.end_to_end - own_extension(before);
  const double zero_after = after.end_to_end - own_extension(after);
  return before.end_to_end > 0.0 && std::abs(zero_after - zero_before) > kSameZero;
}

Pull pull_of(const std::vector<CurveRow>& rows, ExtensionOf extension) {
  Pull pull;
  bool first = true;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!pulls(rows[i].phase)) continue;
    const PullPoint point = point_of(rows[i], extension);
    if (first && i > 0) {
      const PullPoint origin = origin_of(rows[i - 1], rows[i], extension);
      if (origin.extension < point.extension) pull.push_back(origin);
    }
    first = false;
    if (pull.empty() || point.extension > pull.back().extension) pull.push_back(point);
  }
  return pull;
}

}  // namespace knot_utm
