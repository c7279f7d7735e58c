#include "knot_utm/analysis/comparison.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "knot_utm/program/phases.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"
#include "knot_utm/words/yaml_lines.hpp"
#include "pull_integrals.hpp"

namespace knot_utm {

namespace {

constexpr double kMoved = 0.01;   // of the largest growth: extension at which the pull has begun
constexpr double kStill = 0.001;  // of the largest growth: extensions that differ by less are the same
constexpr double kSlip = 0.05;    // of the peak: the load falls

std::vector<CurveRow> pulled(const std::vector<CurveRow>& rows) {
  std::vector<CurveRow> out;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(out), [](const CurveRow& row) { return pulls(row.phase); });
  return out;
}

/// Load at an extension, linear from point to point.
std::optional<double> load_at(const Pull& pull, double extension) {
  const auto next = first_from(pull.begin(), pull.end(), extension);
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
  // The mean is taken of differences, so that the mean of equal readings has exactly their value.
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

namespace {

/// Extensions at which either curve may have a corner, in order.
std::vector<double> corners(const Pull& a, const Pull& b, const Range& common) {
  std::vector<double> out = {common.low, common.high};
  for (const Pull* pull : {&a, &b})
    for (const PullPoint& point : *pull)
      if (point.extension > common.low && point.extension < common.high) out.push_back(point.extension);
  std::sort(out.begin(), out.end());
  return out;
}

struct Reading {
  const char* name;
  std::optional<double> CurveReadings::*value;
  bool judged = true;  ///< compared with the tolerance: not readings that need e, nor those that may be zero
};

constexpr std::array<Reading, 11> kReadings{{{"peak_force", &CurveReadings::peak_force},
                                             {"plateau_force", &CurveReadings::plateau_force},
                                             {"plateau_force_low", &CurveReadings::plateau_force_low, false},
                                             {"plateau_force_high", &CurveReadings::plateau_force_high, false},
                                             {"plateau_force_slope", &CurveReadings::plateau_force_slope, false},
                                             {"breakaway_force", &CurveReadings::breakaway_force},
                                             {"largest_drop", &CurveReadings::largest_drop, false},
                                             {"jump_force", &CurveReadings::jump_force, false},
                                             {"force_after_jump", &CurveReadings::force_after_jump, false},
                                             {"lock_extension_by_load", &CurveReadings::lock_extension_by_load},
                                             {"locked_stiffness", &CurveReadings::locked_stiffness}}};

std::optional<double> difference(const std::optional<double>& a, const std::optional<double>& b) {
  return a && b ? std::optional<double>(*b - *a) : std::nullopt;
}

std::optional<double> over(const std::optional<double>& value, const std::optional<double>& scale) {
  return value && scale && *scale != 0.0 ? std::optional<double>(*value / std::abs(*scale)) : std::nullopt;
}

std::string zero_text(const std::optional<RawZero>& zero) {
  if (!zero) return "own";
  return "{extension: " + format_yaml_number(zero->extension) + ", load: " + format_yaml_number(zero->load) +
         ", readings: " + std::to_string(zero->readings) + ", load_there: " + format_yaml_number(zero->load_there) +
         "}";
}

/// With three digits, unless these would not show that the limit is exceeded.
std::string beside_limit(double value, double limit) {
  const std::string text = short_number(value);
  return parse_number(text) && std::abs(*parse_number(text)) > limit ? text : format_number(value);
}

std::string flow(const std::optional<double>& a, const std::optional<double>& b) {
  const auto text = [](const std::optional<double>& value) { return value ? format_yaml_number(*value) : "null"; };
  const std::optional<double> change = difference(a, b);
  return "{a: " + text(a) + ", b: " + text(b) + ", difference: " + text(change) +
         ", relative: " + text(over(change, a)) + "}";
}

}  // namespace

std::optional<CurveDifference> curve_difference(const Pull& a, const Pull& b) {
  if (a.size() < 2 || b.size() < 2) return std::nullopt;
  CurveDifference out;
  out.common = {std::max(a.front().extension, b.front().extension), std::min(a.back().extension, b.back().extension)};
  if (!(out.common.high > out.common.low)) return std::nullopt;
  out.largest_at = out.common.low;
  double square = 0.0, last = 0.0, last_at = out.common.low;
  for (const double s : corners(a, b, out.common)) {
    const double force = *load_at(a, s), difference = *load_at(b, s) - force;
    if (s == out.common.low) last = difference;
    square += (s - last_at) * (last * last + last * difference + difference * difference) / 3.0;
    if (std::abs(difference) > std::abs(out.largest)) {
      out.largest = difference;
      out.largest_at = s;
    }
    out.load = std::max(out.load, std::abs(force));
    last = difference;
    last_at = s;
  }
  out.rms = std::sqrt(square / (out.common.high - out.common.low));
  return out;
}

Comparison compare(const Pull& first, const Pull& second) {
  const auto knows = [](const Pull& pull) { return pull.empty() || std::isfinite(pull.front().borne); };
  Pull a = first, b = second;
  if (!knows(a) || !knows(b))
    for (Pull* pull : {&a, &b})
      for (PullPoint& point : *pull) point.borne = Sample::kNone;
  // A curve does not say what holds a loop. Between held nodes it would have no plateau in any case.
  constexpr bool kOnRollers = true;
  return {curve_readings(a, kOnRollers), curve_readings(b, kOnRollers), curve_difference(a, b), {}, {}};
}

std::string comparison_yaml(const Comparison& comparison, const std::string& file_a, const std::string& file_b) {
  YamlLines lines;
  lines.text("a", file_a);
  lines.text("b", file_b);
  if (comparison.zeros) {
    lines.word("zero_a", zero_text(comparison.zeros->a));
    lines.word("zero_b", zero_text(comparison.zeros->b));
  }
  if (comparison.difference) {
    const CurveDifference& d = *comparison.difference;
    lines.word("common_extension",
               "[" + format_yaml_number(d.common.low) + ", " + format_yaml_number(d.common.high) + "]");
    lines.number("rms_difference", d.rms);
    lines.number("rms_difference_over_load", d.load > 0.0 ? d.rms / d.load : Sample::kNone);
    lines.number("largest_difference", d.largest);
    lines.number("largest_difference_at", d.largest_at);
  }
  for (const Reading& reading : kReadings)
    lines.word(reading.name, flow(comparison.a.*reading.value, comparison.b.*reading.value));
  if (comparison.over_time) {
    const OverTime &a = (*comparison.over_time)[0], &b = (*comparison.over_time)[1];
    lines.word("peak_time", flow(a.peak_time, b.peak_time));
    lines.word("slips", flow(a.slips, b.slips));
  }
  return lines.all();
}

std::vector<std::string> beyond_tolerance(const Comparison& comparison, double tolerance) {
  std::vector<std::string> out;
  const auto hold = [&](const std::string& name, double relative) {
    if (!(std::abs(relative) <= tolerance))
      out.push_back(name + ": the relative difference is " + beside_limit(relative, tolerance) +
                    ", but must be within " + format_number(tolerance));
  };
  if (comparison.difference && comparison.difference->rms > 0.0)
    hold("rms_difference_over_load", comparison.difference->rms / comparison.difference->load);
  for (const Reading& reading : kReadings) {
    if (!reading.judged) continue;
    const std::optional<double>&a = comparison.a.*reading.value, &b = comparison.b.*reading.value;
    if (a.has_value() != b.has_value())
      out.push_back(std::string(reading.name) + ": only " + (a ? "A" : "B") + " has one");
    else if (a && *a != *b)
      hold(reading.name, (*b - *a) / std::abs(*a));
  }
  return out;
}

namespace {

/// A curve may lack times altogether.
void require_finite(const CurveOfFile& curve) {
  const bool timed = has_its_zero(curve.rows) || (!curve.rows.empty() && std::isfinite(curve.rows.front().time));
  for (std::size_t i = 0; i < curve.rows.size(); ++i) {
    const CurveRow& row = curve.rows[i];
    if (pulls(row.phase) &&
        !((std::isfinite(row.time) || !timed) && std::isfinite(row.extension) && std::isfinite(row.load)))
      throw InvalidInput::sentence("reading",
                                   "reading " + std::to_string(i + 1) + " has no time, no extension or no load")
          .in_file(curve.file);
  }
}

/// One of the two curves.
class Side {
 public:
  Side(CurveOfFile curve, const Tell& tell) : curve_(std::move(curve)), tell_(tell), has_zero_(has_its_zero(rows())) {
    require_finite(curve_);
    require_readings();
    if (!has_zero_) note_left_out();
  }

  bool has_zero() const { return has_zero_; }
  const std::vector<CurveRow>& rows() const { return curve_.rows; }
  const std::optional<RawZero>& given() const { return given_; }

  void keep_zero() const { note("the curve is one of knot_utm and keeps its own zero"); }

  void balance_at_rest(const Pull& other) {
    given_ = zero_at_rest(rows(), other);
    note(zero_words(*given_));
    curve_.rows = balanced(rows(), *given_);
    require_readings();
  }

 private:
  void require_readings() const {
    const std::size_t readings = pull_of(rows()).size();
    if (readings < 2 && !rows().empty() && falls(rows(), &CurveRow::extension))
      throw InvalidInput::sentence("extension",
                                   "the extension falls from its first reading on, so that nothing is pulled: --invert "
                                   "turns its sign")
          .in_file(curve_.file);
    if (readings < 2)
      throw InvalidInput::sentence(
          "pull", rows().size() == 1 ? "there is one reading, but must be at least two"
                                     : "nothing is pulled: no reading has a larger extension than the first one")
          .in_file(curve_.file);
  }
  /// Notes how many readings are left out, because a pull consists of readings beyond all earlier extensions.
  void note_left_out() const {
    constexpr double kBehind = 0.01;  // of the way
    const Pull pull = pull_of(rows());
    const double behind = kBehind * (pull.back().extension - pull.front().extension);
    std::size_t left_out = 0;
    double farthest = pull.front().extension, most = 0.0;
    for (const CurveRow& row : rows()) {
      if (!pulls(row.phase)) continue;
      farthest = std::max(farthest, row.extension);
      if (farthest - row.extension <= behind) continue;
      ++left_out;
      most = std::max(most, farthest - row.extension);
    }
    if (left_out > 0)
      note(std::to_string(left_out) + " of " + std::to_string(rows().size()) +
           " readings are not compared, since they lie up to " + short_number(1e3 * most) +
           " mm behind an extension that was reached before");
  }

  void note(const std::string& words) const { tell_(curve_.file + ": " + words); }

  CurveOfFile curve_;
  const Tell& tell_;
  bool has_zero_;  // of its own
  std::optional<RawZero> given_;
};

OverTime read_over_time(const CurveOfFile& curve, CurveReadings& readings, const Tell& tell) {
  const std::vector<CurveRow> rows = pulled(curve.rows);
  const auto less = [](const CurveRow& a, const CurveRow& b) { return a.load < b.load; };
  const auto peak = std::max_element(rows.begin(), rows.end(), less);
  if (peak == rows.end() || !std::isfinite(peak->load))
    throw InvalidInput::sentence("load", "nothing is pulled, or the first reading has no load").in_file(curve.file);
  if (!has_travel(curve.rows)) tell(curve.file + ": it has no travel: loads are read over time alone, as recorded");
  OverTime out{peak->time - rows.front().time};
  double high = rows.front().load, low = high, largest = 0.0;  // of a rise, and of the fall behind it
  for (auto row = rows.begin(); row <= peak; ++row) {
    low = std::min(low, row->load);
    const bool fell = high - low > kSlip * peak->load, rises = row->load - low > kSlip * peak->load;
    if (fell ? !rises : row->load <= high) continue;
    out.slips += fell;
    if (fell) largest = std::max(largest, high - low);
    high = low = row->load;
  }
  readings.peak_force = peak->load;
  readings.largest_drop = largest;
  return out;
}

ComparedCurves compared_over_time(const CurveOfFile& a, const CurveOfFile& b, const Tell& tell) {
  ComparedCurves out;
  const OverTime first = read_over_time(a, out.comparison.a, tell);
  out.comparison.over_time = {first, read_over_time(b, out.comparison.b, tell)};
  return out;
}

}  // namespace

ComparedCurves compare_curves(CurveOfFile a, CurveOfFile b, bool balances_raw_data, const Tell& tell) {
  if (!has_travel(a.rows) || !has_travel(b.rows)) return compared_over_time(a, b, tell);
  Side side_a(std::move(a), tell), side_b(std::move(b), tell);
  const bool balances = balances_raw_data && !(side_a.has_zero() && side_b.has_zero());
  if (balances) {
    const Side& other = side_a.has_zero() ? side_a : side_b;
    const Pull beside = other.has_zero() ? pull_of(other.rows(), ExtensionOf::kMachine) : Pull();
    if (other.has_zero()) other.keep_zero();
    for (Side* side : {&side_a, &side_b})
      if (!side->has_zero()) side->balance_at_rest(beside);
  }
  const bool both = side_a.has_zero() && side_b.has_zero();
  const ExtensionOf extension = both ? ExtensionOf::kSpecimen : ExtensionOf::kMachine;
  ComparedCurves out{pull_of(side_a.rows(), extension), pull_of(side_b.rows(), extension), {}};
  out.comparison = compare(out.a, out.b);
  if (balances) out.comparison.zeros = GivenZeros{side_a.given(), side_b.given()};
  if (!out.comparison.difference)
    throw InvalidInput::sentence("extensions", "the curves have no extension in common, so they cannot be compared");
  return out;
}

}  // namespace knot_utm
