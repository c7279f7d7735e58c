#include "knot_utm/analysis/curve_readings.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace knot_utm {
namespace {

constexpr double kPlateauBegin = 0.3, kPlateauEnd = 0.8;  // of the way to the lock
constexpr double kLockedLoad = 2.0;                       // times the plateau's mean
constexpr double kEarliestLock = 0.15;                    // of the pull
constexpr double kLevel = 0.5;                            // rise of a plateau over its mean

/// Integrals over a range of s, F being straight from point to point.
struct Integrals {
  double width = 0.0, force = 0.0, square = 0.0, distance_change = 0.0;
};

Integrals integrate(const Pull& pull, const Range& range) {
  Integrals out;
  for (std::size_t i = 1; i < pull.size(); ++i) {
    const PullPoint &a = pull[i - 1], &b = pull[i];
    const double from = std::max(a.extension, range.low), to = std::min(b.extension, range.high);
    if (!(to > from)) continue;
    const double part = (to - from) / (b.extension - a.extension);
    out.width += to - from;
    out.force += (to - from) * 0.5 * (a.force + b.force);
    out.square += (to - from) * 0.5 * (a.force * a.force + b.force * b.force);
    out.distance_change += part * (b.knot_distance - a.knot_distance);
  }
  return out;
}

double mean_force(const Pull& pull, const Range& range) {
  const Integrals part = integrate(pull, range);
  return part.force / part.width;
}

/// Least-squares slope of F over a range of s, F being straight from point to point.
double slope_over(const Pull& pull, const Range& range) {
  const double length = range.high - range.low, middle = 0.5 * (range.low + range.high);
  double moment = 0.0;  // integral of F (s - middle) ds
  for (std::size_t i = 1; i < pull.size(); ++i) {
    const PullPoint &a = pull[i - 1], &b = pull[i];
    const double from = std::max(a.extension, range.low), width = std::min(b.extension, range.high) - from;
    if (!(width > 0.0)) continue;
    const double slope = (b.force - a.force) / (b.extension - a.extension);
    const double arm = from - middle, force = a.force + slope * (from - a.extension);
    moment += width * (force * (arm + width / 2.0) + slope * width * (arm / 2.0 + width / 3.0));
  }
  return 12.0 * moment / (length * length * length);
}

/// Of the slopes over three parts of equal length.
double middle_slope(const Pull& pull, const Range& range) {
  std::array<double, 3> slope;
  for (std::size_t k = 0; k < 3; ++k) {
    const double part = (range.high - range.low) / 3.0, from = range.low + static_cast<double>(k) * part;
    slope[k] = slope_over(pull, {from, from + part});
  }
  std::sort(slope.begin(), slope.end());
  return slope[1];
}

/// The first point of the largest force.
std::size_t peak_of(const Pull& pull) {
  const auto less = [](const PullPoint& a, const PullPoint& b) { return a.force < b.force; };
  return static_cast<std::size_t>(std::max_element(pull.begin(), pull.end(), less) - pull.begin());
}

/// Where F, on the way to the peak, last rises through `force`; the peak where it is above all of it.
double last_rise_through(const Pull& pull, std::size_t peak, double force) {
  std::size_t below = peak;
  while (below > 0 && pull[below].force > force) --below;
  if (below == peak) return pull[peak].extension;
  const PullPoint &a = pull[below], &b = pull[below + 1];
  if (a.force > force) return a.extension;
  return a.extension + (force - a.force) / (b.force - a.force) * (b.extension - a.extension);
}

std::optional<double> lock_by_load(const Pull& pull) {
  const std::size_t peak = peak_of(pull);
  const double start = pull.front().extension, last = pull[peak].extension;
  const double earliest = start + kEarliestLock * (pull.back().extension - start);
  // Each step goes back, by a point or within one piece of the curve: the bound is for roundings at the fixed point.
  double lock = last;
  for (std::size_t step = 0; step < 2 * pull.size() && lock > earliest; ++step) {
    const std::optional<Plateau> before = plateau(pull, lock);
    if (!before || before->force <= 0.0) return std::nullopt;
    const double next = std::min(lock, last_rise_through(pull, peak, kLockedLoad * before->force));
    if (next >= last) return std::nullopt;
    if (lock - next <= 1e-9 * (last - start)) return next;
    lock = next;
  }
  return std::nullopt;
}

}  // namespace

Range plateau_range(const Pull& pull, double end) {
  const double start = pull.front().extension;
  return {start + kPlateauBegin * (end - start), start + kPlateauEnd * (end - start)};
}

double peak_force(const Pull& pull) { return pull[peak_of(pull)].force; }

std::optional<Plateau> plateau(const Pull& pull, double end) {
  if (pull.empty()) return std::nullopt;
  const Range range = plateau_range(pull, end);
  const Integrals part = integrate(pull, range);
  if (!(part.width > 0.0)) return std::nullopt;
  Plateau out;
  out.force = part.force / part.width;
  out.force_sd = std::sqrt(std::max(0.0, part.square / part.width - out.force * out.force));
  out.slope = part.distance_change / part.width;
  const double middle = 0.5 * (range.low + range.high);
  out.rise = 2.0 * (mean_force(pull, {middle, range.high}) - mean_force(pull, {range.low, middle}));
  return out;
}

double breakaway_force(const Pull& pull, double end) {
  if (pull.empty()) return 0.0;
  const double before = plateau_range(pull, end).low;
  double out = 0.0;
  for (const PullPoint& point : pull)
    if (point.extension <= before) out = std::max(out, point.force);
  return out;
}

std::optional<double> locked_stiffness(const Pull& pull, double from) {
  if (pull.empty()) return std::nullopt;
  const double peak = peak_force(pull);
  const std::size_t end = peak_of(pull) + 1;
  std::size_t begin = end;
  while (begin > 0 && pull[begin - 1].extension >= from && (pull[begin - 1].force >= 0.5 * peak || end - begin < 3))
    --begin;
  if (end < begin + 3) return std::nullopt;
  return middle_slope(pull, {pull[begin].extension, pull[end - 1].extension});
}

CurveReadings curve_readings(const Pull& pull) {
  CurveReadings out;
  if (pull.empty()) return out;
  out.peak_force = peak_force(pull);
  out.lock_extension = lock_by_load(pull);
  const std::optional<Plateau> level = plateau(pull, out.lock_extension.value_or(pull.back().extension));
  if (level && (out.lock_extension || std::abs(level->rise) < kLevel * level->force)) {
    out.plateau_force = level->force;
    out.plateau_force_sd = level->force_sd;
  }
  if (out.lock_extension || !out.plateau_force)
    out.locked_stiffness = locked_stiffness(pull, out.lock_extension.value_or(pull.front().extension));
  return out;
}

}  // namespace knot_utm
