#include "knot_utm/analysis/curve_row.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "knot_utm/program/phases.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {
namespace {

constexpr double kSameZero = 1e-9;  // far above rounding, far below what anybody measures [m]

PullPoint point_of(const CurveRow& row, ExtensionOf extension) {
  const double s = extension == ExtensionOf::kMachine ? travel_of(row) : row.extension;
  PullPoint point{row.time, s, row.knot_distance, row.load};
  point.borne = row.load_lower + row.balance_offset;
  return point;
}

/// The point from which the pull began. The force that the rod bears there does not depend on a balance.
PullPoint origin_of(const CurveRow& before, const CurveRow& first, ExtensionOf extension) {
  PullPoint origin = point_of(before, extension);
  if (balanced_between(before, first)) origin.extension = origin.force = 0.0;
  return origin;
}

/// Calls `add` with every point of the pull and the row that it is made of.
template <class Add>
void visit_pull(const std::vector<CurveRow>& rows, ExtensionOf extension, Add add) {
  std::optional<double> farthest;
  bool first = true;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!pulls(rows[i].phase)) continue;
    const PullPoint point = point_of(rows[i], extension);
    if (first && i > 0) {
      const PullPoint origin = origin_of(rows[i - 1], rows[i], extension);
      if (origin.extension < point.extension) {
        add(origin, rows[i - 1]);
        farthest = origin.extension;
      }
    }
    first = false;
    if (farthest && !(point.extension > *farthest)) continue;
    add(point, rows[i]);
    farthest = point.extension;
  }
}

}  // namespace

CurveRow curve_row(const Sample& sample) {
  CurveRow row;
  row.time = sample.time;
  row.extension = sample.extension;
  row.crosshead_travel = sample.raw_extension;
  row.load = sample.load;
  row.knot_distance = sample.knot_distance;
  row.end_to_end = sample.end_to_end;
  row.load_lower = sample.force_lower - sample.balance_offset;
  row.balance_offset = sample.balance_offset;
  row.phase = sample.phase;
  row.excess_length = sample.excess_length;
  return row;
}

double travel_of(const CurveRow& row) {
  return std::isfinite(row.crosshead_travel) ? row.crosshead_travel : row.extension;
}

bool has_travel(const std::vector<CurveRow>& rows) {
  const auto first = std::find_if(rows.begin(), rows.end(), [](const CurveRow& row) { return pulls(row.phase); });
  return first == rows.end() || std::isfinite(first->extension);
}

bool balanced_between(const CurveRow& before, const CurveRow& after) {
  const double zero_before = before.end_to_end - before.extension;
  const double zero_after = after.end_to_end - after.extension;
  return before.end_to_end > 0.0 && std::abs(zero_after - zero_before) > kSameZero;
}

Pull pull_of(const std::vector<CurveRow>& rows, ExtensionOf extension) {
  Pull pull;
  visit_pull(rows, extension, [&](const PullPoint& point, const CurveRow&) { pull.push_back(point); });
  return pull;
}

HiddenRod hidden_rod_of(const std::vector<CurveRow>& rows, ExtensionOf extension) {
  HiddenRod hidden;
  visit_pull(rows, extension, [&](const PullPoint&, const CurveRow& row) { hidden.push_back(row.excess_length); });
  return hidden;
}

}  // namespace knot_utm
