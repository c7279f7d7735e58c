#include "knot_utm/analysis/raw_zero.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "knot_utm/program/phases.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

constexpr double kMoved = 0.01;   // of all growth: the pull has begun
constexpr double kStill = 0.001;  // of all growth: at the same place

std::vector<CurveRow> pulled(const std::vector<CurveRow>& rows) {
  std::vector<CurveRow> out;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(out), [](const CurveRow& row) { return pulls(row.phase); });
  return out;
}

/// Load at an extension, straight from point to point.
std::optional<double> load_at(const Pull& pull, double extension) {
  const auto less = [](const PullPoint& point, double s) { return point.extension < s; };
  const auto next = std::lower_bound(pull.begin(), pull.end(), extension, less);
  if (next == pull.end()) return std::nullopt;
  if (next->extension == extension) return next->force;
  if (next == pull.begin()) return std::nullopt;
  const PullPoint &a = *std::prev(next), &b = *next;
  return a.force + (extension - a.extension) / (b.extension - a.extension) * (b.force - a.force);
}

}  // namespace

bool has_its_zero(const std::vector<CurveRow>& rows) {
  return std::any_of(rows.begin(), rows.end(), [](const CurveRow& row) { return std::isfinite(row.end_to_end); });
}

bool falls(const std::vector<CurveRow>& rows, double CurveRow::*value) {
  double up = 0.0, down = 0.0;
  for (const CurveRow& row : rows) {
    up = std::max(up, row.*value - rows.front().*value);
    down = std::max(down, rows.front().*value - row.*value);
  }
  return down > up;
}

RawZero zero_at_rest(const std::vector<CurveRow>& rows, const Pull& other) {
  const std::vector<CurveRow> all = pulled(rows);
  const double start = all.front().extension;
  double growth = 0.0;
  for (const CurveRow& row : all) growth = std::max(growth, row.extension - start);
  RawZero zero{};
  for (std::size_t i = 0; i < all.size() && all[i].extension <= start + kMoved * growth; ++i)
    if (all[i].extension <= start) zero.first = i;
  // The mean is one of differences, so that equal readings have themselves as their mean, to the last digit.
  const CurveRow& last = all[zero.first];
  double extension = 0.0, load = 0.0;
  zero.readings = 0;
  for (std::size_t i = zero.first + 1; i-- > 0;) {
    if (std::abs(all[i].extension - last.extension) > kStill * growth) break;
    extension += all[i].extension - last.extension;
    load += all[i].load - last.load;
    ++zero.readings;
  }
  zero.extension = last.extension + extension / static_cast<double>(zero.readings);
  zero.load = last.load + load / static_cast<double>(zero.readings);
  zero.load_there = load_at(other, 0.0).value_or(0.0);
  return zero;
}

std::optional<RawZero> zero_of_cut(const std::vector<CurveRow>& rows, double begins_at, const Pull& other) {
  const CurveRow first = pulled(rows).front();
  const std::optional<double> load = load_at(other, begins_at);
  if (!load) return std::nullopt;
  return RawZero{first.extension - begins_at, first.load, *load};
}

std::string zero_words(const RawZero& zero) {
  const std::string place = short_number(zero.load) + " N at " + short_number(zero.extension) + " m";
  std::string there;
  if (zero.load_there != 0.0)
    there = "; its load there becomes " + short_number(zero.load_there) + " N, as that of the other curve";
  if (zero.readings > 1)
    return "zero is " + place + ", the mean of its " + std::to_string(zero.readings) +
           " readings before the crosshead moves" + there;
  return "the record shows no rest before the pull, so its first reading, " + place + ", is taken for zero" + there;
}

std::vector<CurveRow> balanced(const std::vector<CurveRow>& rows, const RawZero& zero) {
  std::vector<CurveRow> out = pulled(rows);
  out.erase(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(zero.first));
  for (CurveRow& row : out) {
    row.extension -= zero.extension;
    row.load -= zero.load - zero.load_there;
  }
  return out;
}

}  // namespace knot_utm
