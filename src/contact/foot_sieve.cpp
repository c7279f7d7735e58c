#include "knot_utm/contact/foot_sieve.hpp"

#include <algorithm>

namespace knot_utm {

namespace {

constexpr int kLanes = 4;
constexpr double kRounding = 1e-9;  // more than what rounding does to F' [fraction of the edge squared]

}  // namespace

FootSieve::FootSieve(Eigen::Index nodes)
    : edges_(static_cast<std::size_t>(nodes + kLanes - 1) / kLanes),
      least_begin_(Eigen::VectorXd::Zero(nodes)),
      least_end_(Eigen::VectorXd::Zero(nodes)) {
  for (int p = 0; p < 2; ++p) {
    slope_[p].resize(edges_.size());
    left_[p].resize(static_cast<std::size_t>(nodes));
  }
}

void FootSieve::set_centreline(const Points& edge_middle, const Points& edge) {
  const int edges = static_cast<int>(edge.cols());
  for (int j = 0; j < edges; ++j) {
    FourEdges& four = edges_[static_cast<std::size_t>(j / kLanes)];
    for (int i = 0; i < 3; ++i) four.e[i][j % kLanes] = edge(i, j);
    four.me[j % kLanes] = edge_middle.col(j).dot(edge.col(j));
  }
  for (int segment = 1; segment < edges; ++segment) {
    const Vec3 t = edge.col(segment - 1), k = edge.col(segment) - t;
    const double tk = t.dot(k), kk = k.squaredNorm(), rounding = kRounding * t.squaredNorm();
    const double a = 1.5 * tk + 0.5 * kk, b = 1.5 * tk + kk;
    least_begin_[segment] = std::max({0.5 * a, b, 0.0}) + rounding;
    least_end_[segment] = std::min({a, 0.5 * b, 0.0}) - rounding;
  }
}

void FootSieve::sieve(const Vec3& a0, const Vec3& a1, const Candidates::Run* begin, const Candidates::Run* end) {
  const double* slope[2];
  for (int p = 0; p < 2; ++p) slope[p] = reinterpret_cast<const double*>(slope_[p].data());
  std::size_t count[2] = {0, 0};
  for (const Candidates::Run* run = begin; run != end; ++run) {
    const auto first = static_cast<std::size_t>((run->first - 1) / kLanes);
    const auto last = static_cast<std::size_t>(run->last / kLanes);
    for (std::size_t four = first; four <= last; ++four) {
      slope_[0][four] = edges_[four].slope(a0);
      slope_[1][four] = edges_[four].slope(a1);
    }
    // Whether a segment is left is hard to foretell: it is written down in any case and counted where it is.
    for (int segment = run->first; segment <= run->last; ++segment)
      for (int p = 0; p < 2; ++p) {
        const bool begins = slope[p][segment - 1] < least_begin_[segment],
                   ends = slope[p][segment] >= least_end_[segment];
        left_[p][count[p]] = segment;
        count[p] += static_cast<std::size_t>(begins & ends);
      }
  }
  std::copy_n(count, 2, count_);
}

}  // namespace knot_utm
