#include "knot_utm/analysis/curve_readings.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pull_integrals.hpp"

namespace knot_utm {
namespace {

constexpr double kPlateauBegin = 0.3, kPlateauEnd = 0.8;  // of the way to the lock
constexpr double kLockedLoad = 2.0;                       // times the plateau's mean
constexpr double kEarliestLock = 0.15;                    // of the pull
constexpr double kLevel = 0.5;                            // rise of a plateau over its mean

double mean_force(const Pull& pull, const Range& range) {
  const Integrals part = integrate(pull, range);
  return part.force / part.width;
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

std::optional<double> lock_by_load(const Pull& pull) {
  const WayToPeak way(pull);
  const double length = way.end() - way.start();
  const double earliest = way.start() + kEarliestLock * (pull.back().extension - way.start());
  // Steps go back by a share each, unless F grows in about proportion to s: then there is no lock to be found.
  constexpr int kMostSteps = 1000;
  double lock = way.end();
  for (int step = 0; step < kMostSteps && lock > earliest; ++step) {
    const double mean = way.mean_force(plateau_range(pull, lock));
    if (!(mean > 0.0)) return std::nullopt;
    const double next = std::min(lock, way.last_rise_through(kLockedLoad * mean));
    if (next >= way.end()) return std::nullopt;
    if (lock - next <= 1e-9 * length) return next;
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
  const std::optional<double> lock = lock_by_load(pull);
  out.lock_extension_by_load = lock;
  const double end = lock.value_or(pull.back().extension);
  const std::optional<Plateau> level = plateau(pull, end);
  if (level && (lock || std::abs(level->rise) < kLevel * level->force)) {
    out.plateau_force = level->force;
    out.plateau_force_sd = level->force_sd;
    out.breakaway_force = breakaway_force(pull, end);
  }
  if (lock || !out.plateau_force) out.locked_stiffness = locked_stiffness(pull, lock.value_or(pull.front().extension));
  return out;
}

}  // namespace knot_utm
