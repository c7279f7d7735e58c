#include "knot_utm/analysis/comparison.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "knot_utm/record/sample.hpp"
#include "knot_utm/words/number.hpp"
#include "knot_utm/words/yaml_lines.hpp"

namespace knot_utm {
namespace {

/// F of a pull at extensions that only grow.
class Walk {
 public:
  explicit Walk(const Pull& pull) : pull_(pull) {}

  double force_at(double extension) {
    while (next_ + 1 < pull_.size() && pull_[next_].extension < extension) ++next_;
    const PullPoint &a = pull_[next_ - 1], &b = pull_[next_];
    const double fraction = (extension - a.extension) / (b.extension - a.extension);
    return a.force + std::clamp(fraction, 0.0, 1.0) * (b.force - a.force);
  }

 private:
  const Pull& pull_;
  std::size_t next_ = 1;
};

/// Where either curve may have a corner, in order.
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
  bool judged = true;  ///< held against the tolerance: not what curves without e cannot tell, nor what may be zero
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

/// With three digits, unless these are those of the limit.
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
  Walk along_a(a), along_b(b);
  double square = 0.0, last = 0.0, last_at = out.common.low;
  for (const double s : corners(a, b, out.common)) {
    const double force = along_a.force_at(s), difference = along_b.force_at(s) - force;
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
  // A curve does not say what holds a loop; one between held nodes would have no plateau by either rule.
  constexpr bool kOnRollers = true;
  return {curve_readings(a, kOnRollers), curve_readings(b, kOnRollers), curve_difference(a, b), std::nullopt};
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

}  // namespace knot_utm
