#include <algorithm>

#include "knot_utm/contact/foot_search.hpp"

namespace knot_utm {
namespace {

constexpr int kLanesOfSieve = 4, kPoints = 2;
constexpr double kSieveRounding = 1e-9;  // more than what rounding does to F' [fraction of the edge squared]

}  // namespace

FootSieve::FootSieve(Eigen::Index nodes) : edges_(static_cast<std::size_t>(nodes / kLanesOfSieve + 1)) {
  for (std::vector<int>& left : left_) left.resize(static_cast<std::size_t>(nodes));
}

void FootSieve::set_centreline(const Points& position) {
  const int edges = static_cast<int>(position.cols()) - 1;
  Lanes t = {};
  double tt = 0.0;
  for (int j = 0; j < edges; ++j) {
    const double* x = position.data() + 3 * j;
    const Lanes here = to_lanes(x), next = to_lanes(x + 3), e = next - here;
    FourEdges& four = edges_[static_cast<std::size_t>(j / kLanesOfSieve)];
    const int lane = j % kLanesOfSieve;
    for (int i = 0; i < 3; ++i) four.e[i][lane] = e[i];
    four.me[lane] = 0.5 * dot(here + next, e);
    const double ee = dot(e, e);
    if (j > 0) {
      const Lanes k = e - t;
      const double tk = dot(t, k), kk = dot(k, k), rounding = kSieveRounding * tt;
      const double a = 1.5 * tk + 0.5 * kk, b = 1.5 * tk + kk;
      four.least_begin[lane] = std::max({0.5 * a, b, 0.0}) + rounding;
      four.least_end[lane] = std::min({a, 0.5 * b, 0.0}) - rounding;
    }
    t = e;
    tt = ee;
  }
}

void FootSieve::sieve(const Lanes& first_point, const Lanes& second_point, const Candidates::Run* begin,
                      const Candidates::Run* end) {
  const Lanes points[kPoints] = {first_point, second_point};
  std::size_t count[kPoints] = {};
  for (const Candidates::Run* run = begin; run != end; ++run) {
    const int first = run->first / kLanesOfSieve, last = run->last / kLanesOfSieve;
    Lanes before[kPoints] = {};
    if (first > 0)
      for (int p = 0; p < kPoints; ++p) before[p] = edges_[static_cast<std::size_t>(first - 1)].slope(points[p]);
    for (int i = first; i <= last; ++i) {
      const FourEdges& four = edges_[static_cast<std::size_t>(i)];
      LanesMask left[kPoints];
      LanesMask some = {};
      for (int p = 0; p < kPoints; ++p) {
        const Lanes ends = four.slope(points[p]);
        const Lanes begins = one_later(before[p], ends);
        left[p] = (begins < four.least_begin) & (ends >= four.least_end);
        before[p] = ends;
        some |= left[p];
      }
      if (!any(some)) continue;
      const int low = std::max(run->first - kLanesOfSieve * i, 0),
                high = std::min(run->last - kLanesOfSieve * i, kLanesOfSieve - 1);
      for (int lane = low; lane <= high; ++lane)
        for (int p = 0; p < kPoints; ++p)
          if (left[p][lane]) left_[p][count[p]++] = kLanesOfSieve * i + lane;
    }
  }
  std::copy_n(count, kPoints, count_);
}

}  // namespace knot_utm
