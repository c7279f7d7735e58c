#include "knot_utm/analysis/curve_readings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace knot_utm {
namespace {

constexpr double kPlateauBegin = 0.3, kPlateauEnd = 0.8;  // of the way to the lock
constexpr double kLockedLoad = 2.0;                       // times the plateau's mean
constexpr double kEarliestLock = 0.15;                    // of the pull
constexpr double kLevel = 0.5;                            // rise of a plateau over its mean

/// What stands of the piece of a curve from a to b, straight between them, in a range of s.
struct Piece {
  double width;     // of s; none where it is not positive
  double from, to;  // F at its ends
  double share;     // of the piece

  Piece(const PullPoint& a, const PullPoint& b, const Range& range) {
    const double begin = std::max(a.extension, range.low), length = b.extension - a.extension;
    width = std::min(b.extension, range.high) - begin;
    const double slope = (b.force - a.force) / length;
    from = a.force + slope * (begin - a.extension);
    to = from + slope * width;
    share = width / length;
  }
};

/// Integrals over a range of s, F being straight from point to point.
struct Integrals {
  double width = 0.0, force = 0.0, square = 0.0, distance_change = 0.0;
};

Integrals integrate(const Pull& pull, const Range& range) {
  Integrals out;
  for (std::size_t i = 1; i < pull.size(); ++i) {
    const PullPoint &a = pull[i - 1], &b = pull[i];
    const Piece piece(a, b, range);
    if (!(piece.width > 0.0)) continue;
    out.width += piece.width;
    out.force += piece.width * (piece.from + piece.to) / 2.0;
    out.square += piece.width * (piece.from * piece.from + piece.from * piece.to + piece.to * piece.to) / 3.0;
    out.distance_change += piece.share * (b.knot_distance - a.knot_distance);
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
    const Piece piece(pull[i - 1], pull[i], range);
    if (!(piece.width > 0.0)) continue;
    const double arm = std::max(pull[i - 1].extension, range.low) - middle, rise = piece.to - piece.from;
    moment += piece.width * (piece.from * (arm + piece.width / 2.0) + rise * (arm / 2.0 + piece.width / 3.0));
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

/// The way of a pull to its peak, for questions that are asked many times.
class WayToPeak {
 public:
  explicit WayToPeak(const Pull& pull) : pull_(pull), peak_(peak_of(pull)), work_(peak_ + 1, 0.0), least_(peak_ + 1) {
    for (std::size_t i = 1; i <= peak_; ++i)
      work_[i] = work_[i - 1] + 0.5 * (pull[i].extension - pull[i - 1].extension) * (pull[i].force + pull[i - 1].force);
    least_[peak_] = pull[peak_].force;
    for (std::size_t i = peak_; i-- > 0;) least_[i] = std::min(least_[i + 1], pull[i].force);
  }

  double start() const { return pull_.front().extension; }
  double end() const { return pull_[peak_].extension; }
  double mean_force(const Range& range) const {
    return (work_to(range.high) - work_to(range.low)) / (range.high - range.low);
  }

  /// Where F last rises through `force`; the end where it never does.
  double last_rise_through(double force) const {
    // The least F from a point on only grows from point to point.
    const auto above = std::upper_bound(least_.begin(), least_.end(), force);
    if (above == least_.end()) return end();
    if (above == least_.begin()) return start();
    const auto next = static_cast<std::size_t>(above - least_.begin());
    const PullPoint &a = pull_[next - 1], &b = pull_[next];
    return a.extension + (force - a.force) / (b.force - a.force) * (b.extension - a.extension);
  }

 private:
  double work_to(double extension) const {
    const auto less = [](const PullPoint& point, double s) { return point.extension < s; };
    const auto last = pull_.begin() + static_cast<std::ptrdiff_t>(peak_);
    const auto next = std::lower_bound(pull_.begin() + 1, last, extension, less);
    const Piece piece(*(next - 1), *next, {(next - 1)->extension, extension});
    return work_[static_cast<std::size_t>(next - pull_.begin()) - 1] + piece.width * (piece.from + piece.to) / 2.0;
  }

  const Pull& pull_;
  std::size_t peak_;
  std::vector<double> work_;   // integral of F from the first point to each [J]
  std::vector<double> least_;  // F from each point to the peak [N]
};

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
