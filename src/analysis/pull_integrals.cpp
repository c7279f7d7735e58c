#include "pull_integrals.hpp"

namespace knot_utm {
namespace {

/// The first point from s on; at least the second, so that there is one before it.
std::size_t next_point(const Pull& pull, std::size_t end, double s) {
  return static_cast<std::size_t>(first_from(pull.begin() + 1, pull.begin() + static_cast<std::ptrdiff_t>(end), s) -
                                  pull.begin());
}

}  // namespace

Integrals integrate(const Pull& pull, const Range& range) {
  Integrals out;
  for (std::size_t i = 1; i < pull.size(); ++i) {
    const PullPoint &a = pull[i - 1], &b = pull[i];
    const Piece piece(a, b, range);
    if (!(piece.width > 0.0)) continue;
    out.width += piece.width;
    out.force += piece.width * (piece.from + piece.to) / 2.0;
    out.square += piece.width * (piece.from * piece.from + piece.from * piece.to + piece.to * piece.to) / 3.0;
    out.distance_change += piece.fraction * (b.knot_distance - a.knot_distance);
  }
  return out;
}

double slope_over(const Pull& pull, const Range& range) {
  const double length = range.high - range.low, middle = 0.5 * (range.low + range.high);
  double moment = 0.0;  // integral of F (s - middle) ds
  for (std::size_t i = next_point(pull, pull.size(), range.low); i < pull.size(); ++i) {
    if (pull[i - 1].extension >= range.high) break;
    const Piece piece(pull[i - 1], pull[i], range);
    if (!(piece.width > 0.0)) continue;
    moment += moment_of(std::max(pull[i - 1].extension, range.low) - middle, piece.width, piece.from, piece.to);
  }
  return 12.0 * moment / (length * length * length);
}

std::size_t peak_of(const Pull& pull) {
  const auto less = [](const PullPoint& a, const PullPoint& b) { return a.force < b.force; };
  return static_cast<std::size_t>(std::max_element(pull.begin(), pull.end(), less) - pull.begin());
}

PullToPeak::PullToPeak(const Pull& pull)
    : pull_(pull), peak_(peak_of(pull)), sums_(peak_ + 1, {0.0, 0.0}), least_(peak_ + 1) {
  for (std::size_t i = 1; i <= peak_; ++i) {
    const PullPoint &a = pull[i - 1], &b = pull[i];
    const double width = b.extension - a.extension;
    sums_[i].work = sums_[i - 1].work + 0.5 * width * (b.force + a.force);
    sums_[i].moment = sums_[i - 1].moment + moment_of(a.extension - start(), width, a.force, b.force);
  }
  least_[peak_] = pull[peak_].force;
  for (std::size_t i = peak_; i-- > 0;) least_[i] = std::min(least_[i + 1], pull[i].force);
}

double PullToPeak::last_rise_through(double force) const {
  // The least F from a point on only grows from point to point.
  const auto above = std::upper_bound(least_.begin(), least_.end(), force);
  if (above == least_.end()) return end();
  if (above == least_.begin()) return start();
  const auto next = static_cast<std::size_t>(above - least_.begin());
  const PullPoint &a = pull_[next - 1], &b = pull_[next];
  return a.extension + (force - a.force) / (b.force - a.force) * (b.extension - a.extension);
}

double PullToPeak::slope(const Range& range) const {
  const Sums low = sums_to(range.low), high = sums_to(range.high);
  const double length = range.high - range.low, arm = 0.5 * (range.low + range.high) - start();
  return 12.0 * (high.moment - low.moment - arm * (high.work - low.work)) / (length * length * length);
}

PullToPeak::Sums PullToPeak::sums_to(double extension) const {
  const std::size_t next = next_point(pull_, peak_, extension);
  const Piece piece(pull_[next - 1], pull_[next], {pull_[next - 1].extension, extension});
  const double arm = pull_[next - 1].extension - start();
  return {sums_[next - 1].work + piece.width * (piece.from + piece.to) / 2.0,
          sums_[next - 1].moment + moment_of(arm, piece.width, piece.from, piece.to)};
}

}  // namespace knot_utm
