#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "knot_utm/analysis/curve_readings.hpp"

namespace knot_utm {

/// First moment of F about a place, the integral of F (s - place) ds over an interval of length `width` that begins at
/// place + `arm`. F varies linearly from `from` to `to`.
inline double moment_of(double arm, double width, double from, double to) {
  return width * (from * (arm + width / 2.0) + (to - from) * (arm / 2.0 + width / 3.0));
}

/// The part of a curve between the points a and b that lies in a range of s. F varies linearly from a to b.
struct Piece {
  double width;     // extension of the part; not positive: nothing of it lies in the range
  double from, to;  // F at the ends of the part
  double fraction;  // the part over the distance from a to b

  Piece(const PullPoint& a, const PullPoint& b, const Range& range) {
    const double begin = std::max(a.extension, range.low), length = b.extension - a.extension;
    width = std::min(b.extension, range.high) - begin;
    const double slope = (b.force - a.force) / length;
    from = a.force + slope * (begin - a.extension);
    to = from + slope * width;
    fraction = width / length;
  }
};

/// Integrals over a range of s: its width, that of F, that of F squared, and the change of e. F is interpolated
/// linearly between the points.
struct Integrals {
  double width = 0.0, force = 0.0, square = 0.0, distance_change = 0.0;
};
Integrals integrate(const Pull& pull, const Range& range);

/// Mean of F over a range that the pull covers.
inline double mean_over(const Pull& pull, const Range& range) {
  const Integrals part = integrate(pull, range);
  return part.force / part.width;
}

/// The first point with an extension of s or more; `end`: none.
inline Pull::const_iterator first_from(Pull::const_iterator begin, Pull::const_iterator end, double s) {
  return std::lower_bound(begin, end, s, [](const PullPoint& point, double at) { return point.extension < at; });
}

/// Number of points in a range.
inline std::ptrdiff_t count_within(const Pull& pull, const Range& range) {
  return std::count_if(pull.begin(), pull.end(), [&](const PullPoint& point) {
    return point.extension >= range.low && point.extension <= range.high;
  });
}

/// Least-squares slope of F over a range of s. F is interpolated linearly between the points.
double slope_over(const Pull& pull, const Range& range);

/// Index of the first point at which F is largest.
std::size_t peak_of(const Pull& pull);

/// The part of a pull up to its peak, prepared for many queries. The pull must have a point, and must outlive this
/// object.
class PullToPeak {
 public:
  explicit PullToPeak(const Pull& pull);

  double start() const { return pull_.front().extension; }
  double end() const { return pull_[peak_].extension; }
  double work() const { return sums_.back().work; }
  double mean_force(const Range& range) const {
    return (work_to(range.high) - work_to(range.low)) / (range.high - range.low);
  }

  /// Least-squares slope of F over a range. It equals that of slope_over up to rounding, because it is made from sums
  /// that begin at the first point.
  double slope(const Range& range) const;

  bool is_below(double force) const { return least_.front() <= force; }  ///< whether F is anywhere as low as this

  /// The extension at which F last rises through `force`. The end where F never exceeds it, the start where F is never
  /// below it.
  double last_rise_through(double force) const;

 private:
  /// Integrals from the start of the pull.
  struct Sums {
    double work, moment;  // integrals of F [J] and of F (s - start) [J m]
  };
  Sums sums_to(double extension) const;
  double work_to(double extension) const { return sums_to(extension).work; }

  const Pull& pull_;
  std::size_t peak_;
  std::vector<Sums> sums_;     // from the first point to each
  std::vector<double> least_;  // least F from each point to the peak [N]
};

}  // namespace knot_utm
