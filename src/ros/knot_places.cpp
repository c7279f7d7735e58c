#include "knot_utm/ros/knot_places.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "knot_utm/ros/markers.hpp"

namespace knot_utm {
namespace {

constexpr double kTouching = 2.6;  // distance of two nodes on strands that touch; two radii and what edges add [radius]
constexpr double kApart = 10.0;    // along the rod, before two nodes are of different strands [radius]
constexpr double kKnot = 11.0;     // half of the width of a knot with its surroundings [radius]
constexpr int kRounds = 20;

/// For each node, whether another strand lies against it. A node that is a gap away from touching lets those be left
/// out that are less than the gap further along the rod.
std::vector<bool> touched(const Points& points, double radius) {
  const Eigen::Index n = points.cols();
  std::vector<double> along(static_cast<std::size_t>(n), 0.0);
  for (Eigen::Index i = 1; i < n; ++i)
    along[static_cast<std::size_t>(i)] =
        along[static_cast<std::size_t>(i - 1)] + (points.col(i) - points.col(i - 1)).norm();
  std::vector<bool> out(along.size(), false);
  for (std::size_t a = 0; a < along.size(); ++a) {
    auto next = std::upper_bound(along.begin(), along.end(), along[a] + kApart * radius);
    while (next != along.end()) {
      const auto b = static_cast<std::size_t>(next - along.begin());
      const double gap = (points.col(static_cast<Eigen::Index>(b)) - points.col(static_cast<Eigen::Index>(a))).norm() -
                         kTouching * radius;
      if (gap < 0.0) out[a] = out[b] = true;
      ++next;
      if (gap > 0.0) next = std::lower_bound(next, along.end(), along[b] + gap);
    }
  }
  return out;
}

/// The two places along z around which the weights lie, by the method of k means, as mean points.
std::pair<Vec3, Vec3> two_middles(const Points& points, const Eigen::VectorXd& weight) {
  double low = 0.0, high = 0.0;
  bool first = true;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (!(weight[i] > 0.0)) continue;
    low = first ? points(2, i) : std::min(low, points(2, i));
    high = first ? points(2, i) : std::max(high, points(2, i));
    first = false;
  }
  Vec3 lower(0.0, 0.0, low), upper(0.0, 0.0, high);
  for (int round = 0; round < kRounds; ++round) {
    const double border = 0.5 * (lower.z() + upper.z());
    Vec3 sum_lower = Vec3::Zero(), sum_upper = Vec3::Zero();
    double weight_lower = 0.0, weight_upper = 0.0;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const bool above = points(2, i) > border;
      (above ? sum_upper : sum_lower) += weight[i] * points.col(i);
      (above ? weight_upper : weight_lower) += weight[i];
    }
    if (weight_lower > 0.0) lower = sum_lower / weight_lower;
    if (weight_upper > 0.0) upper = sum_upper / weight_upper;
  }
  return {lower, upper};
}

}  // namespace

std::optional<KnotPlaces> find_knots(const Points& points, double radius, bool two) {
  const std::vector<bool> touching = touched(points, radius);
  const auto first = std::find(touching.begin(), touching.end(), true) - touching.begin();
  if (first == static_cast<std::ptrdiff_t>(touching.size())) return {};
  const auto last = static_cast<std::ptrdiff_t>(touching.size()) - 1 -
                    (std::find(touching.rbegin(), touching.rend(), true) - touching.rbegin());
  Eigen::VectorXd weight = curvature_at_nodes(points, radius).cwiseAbs2();
  for (Eigen::Index i = 1; i + 1 < points.cols(); ++i) {
    const double length = 0.5 * (points.col(i + 1) - points.col(i - 1)).norm();
    weight[i] *= touching[static_cast<std::size_t>(i)] ? length : 0.0;
  }
  if (!(weight.maxCoeff() > 0.0)) return {};
  const auto [lower, upper] = two_middles(points, weight);
  const Vec3 around = Vec3::Constant(kKnot * radius);
  KnotPlaces found{lower, upper, Box::around(lower, around)};
  if (two) {
    found.all.take_in(upper - around);
    found.all.take_in(upper + around);
  } else {
    for (std::ptrdiff_t i = first; i <= last; ++i) found.all.take_in(points.col(i));
  }
  return found;
}

}  // namespace knot_utm
