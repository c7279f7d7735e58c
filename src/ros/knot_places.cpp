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

constexpr std::size_t kTogether = 8;  // nodes in a row that are kept apart from others by one comparison

/// Nodes in a row, and a ball that holds them.
struct Row {
  std::size_t begin, end;
  Vec3 middle;
  double reach;
};

Vec3 node(const Points& points, std::size_t i) { return points.col(static_cast<Eigen::Index>(i)); }

std::vector<Row> rows_of_nodes(const Points& points) {
  const auto n = static_cast<std::size_t>(points.cols());
  std::vector<Row> out;
  for (std::size_t begin = 0; begin < n; begin += kTogether) {
    Row row{begin, std::min(n, begin + kTogether), node(points, begin), 0.0};
    row.middle = 0.5 * (row.middle + node(points, row.end - 1));
    for (std::size_t i = begin; i < row.end; ++i)
      row.reach = std::max(row.reach, (node(points, i) - row.middle).norm());
    out.push_back(row);
  }
  return out;
}

/// For each node, whether another strand lies against it.
std::vector<bool> touched(const Points& points, double radius, const std::vector<int>& cuts) {
  std::vector<double> along(static_cast<std::size_t>(points.cols()), 0.0);
  for (std::size_t i = 1; i < along.size(); ++i)
    along[i] = along[i - 1] + (node(points, i) - node(points, i - 1)).norm();
  std::vector<bool> out(along.size(), false);
  const double touching = kTouching * radius, apart = kApart * radius;
  // No place of one rope is near one of the next along the rod.
  for (const int cut : cuts)
    for (auto i = static_cast<std::size_t>(cut) + 1; i < along.size(); ++i) along[i] += 1.01 * apart;
  const std::vector<Row> rows = rows_of_nodes(points);
  for (std::size_t first = 0; first < rows.size(); ++first) {
    for (std::size_t second = first; second < rows.size(); ++second) {
      const Row &a = rows[first], &b = rows[second];
      if (along[b.end - 1] <= along[a.begin] + apart) continue;
      const double near = touching * (1.0 + 1e-9) + a.reach + b.reach;
      if ((b.middle - a.middle).squaredNorm() > near * near) continue;
      for (std::size_t i = a.begin; i < a.end; ++i)
        for (std::size_t j = b.begin; j < b.end; ++j)
          if (along[j] > along[i] + apart && (node(points, j) - node(points, i)).norm() - touching < 0.0)
            out[i] = out[j] = true;
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
    if (0.5 * (lower.z() + upper.z()) == border) break;  // further rounds change nothing
  }
  return {lower, upper};
}

}  // namespace

std::optional<KnotPlaces> find_knots(const Points& points, double radius, bool two, const std::vector<int>& cuts) {
  const std::vector<bool> touching = touched(points, radius, cuts);
  const auto first = std::find(touching.begin(), touching.end(), true) - touching.begin();
  if (first == static_cast<std::ptrdiff_t>(touching.size())) return {};
  const auto last = static_cast<std::ptrdiff_t>(touching.size()) - 1 -
                    (std::find(touching.rbegin(), touching.rend(), true) - touching.rbegin());
  Eigen::VectorXd weight = curvature_at_nodes(points, radius, cuts).cwiseAbs2();
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
