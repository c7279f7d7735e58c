#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "knot_utm/analysis/curve_readings.hpp"

namespace knot_utm {

/// Integral of F (s - place) ds over a piece of `width` that begins `arm` behind the place, F going from `from` to
/// `to`.
inline double moment_of(double arm, double width, double from, double to) {
  return width * (from * (arm + width / 2.0) + (to - from) * (arm / 2.0 + width / 3.0));
}

/// What stands of the piece of a curve from a to b, straight between them, in a range of s.
struct Piece {
  double width;     // of s; none where it is not positive
  double from, to;  // F at its ends
  double fraction;  // of the piece

  Piece(const PullPoint& a, const PullPoint& b, const Range& range) {
    const double begin = std::max(a.extension, range.low), length = b.extension - a.extension;
    width = std::min(b.extension, range.high) - begin;
    const double slope = (b.force - a.force) / length;
    from = a.force + slope * (begin - a.extension);
    to = from + slope * width;
    fraction = width / length;
  }
};

/// Integrals over a range of s, F being straight from point to point.
struct Integrals {
  double width = 0.0, force = 0.0, square = 0.0, distance_change = 0.0;
};
Integrals integrate(const Pull& pull, const Range& range);

/// Least-squares slope of F over a range of s, F being straight from point to point.
double slope_over(const Pull& pull, const Range& range);

/// The first point of the largest force.
std::size_t peak_of(const Pull& pull);

/// The way of a pull to its peak, for questions that are asked many times. The pull has a point, and outlives this.
class WayToPeak {
 public:
  explicit WayToPeak(const Pull& pull);

  double start() const { return pull_.front().extension; }
  double end() const { return pull_[peak_].extension; }
  double work() const { return sums_.back().work; }
  double mean_force(const Range& range) const {
    return (work_to(range.high) - work_to(range.low)) / (range.high - range.low);
  }

  /// Least-squares slope of F over a range, as slope_over, for the rounding of sums from the start.
  double slope(const Range& range) const;

  bool is_below(double force) const { return least_.front() <= force; }  ///< somewhere

  /// Where F last rises through `force`; the end where it never does, the start where it is never below.
  double last_rise_through(double force) const;

 private:
  /// Integrals from the start.
  struct Sums {
    double work, moment;  // of F [J], of F (s - start) [J m]
  };
  Sums sums_to(double extension) const;
  double work_to(double extension) const { return sums_to(extension).work; }

  const Pull& pull_;
  std::size_t peak_;
  std::vector<Sums> sums_;     // from the first point to each
  std::vector<double> least_;  // F from each point to the peak [N]
};

}  // namespace knot_utm
