#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "knot_utm/analysis/curve_readings.hpp"

namespace knot_utm {

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
  double work() const { return work_.back(); }
  double mean_force(const Range& range) const {
    return (work_to(range.high) - work_to(range.low)) / (range.high - range.low);
  }

  bool is_below(double force) const { return least_.front() <= force; }  ///< somewhere

  /// Where F last rises through `force`; the end where it never does, the start where it is never below.
  double last_rise_through(double force) const;

 private:
  double work_to(double extension) const;

  const Pull& pull_;
  std::size_t peak_;
  std::vector<double> work_;   // integral of F from the first point to each [J]
  std::vector<double> least_;  // F from each point to the peak [N]
};

}  // namespace knot_utm
