#include "knot_utm/analysis/curve_difference.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

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

}  // namespace knot_utm
