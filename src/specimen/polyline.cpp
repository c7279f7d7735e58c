#include "knot_utm/specimen/polyline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "knot_utm/contact/closest_points.hpp"
#include "knot_utm/numeric/pieces.hpp"

namespace knot_utm {
namespace {

/// Lays equal chords along a polyline.
class ChordWalk {
 public:
  explicit ChordWalk(const Points& points) : points_(points), arclength_(arclengths(points)) {}

  double length() const { return arclength_.back(); }

  /// How many chords of this length fit, an incomplete last one counting as a fraction. `visit` gets the end of every
  /// whole chord, and its arclength on the polyline.
  template <typename Visit>
  double walk(double chord, Visit visit) const {
    Vec3 from = points_.col(0);
    Eigen::Index segment = 0;
    double along = 0.0;  // of `from` on the segment
    double chords = 0.0;
    const double chord2 = chord * chord;
    while (true) {
      while (segment + 1 < points_.cols() - 1 && (points_.col(segment + 1) - from).squaredNorm() < chord2) {
        ++segment;
        along = 0.0;
      }
      const Vec3 base = points_.col(segment);
      const Vec3 edge = points_.col(segment + 1) - base;
      if ((base + edge - from).squaredNorm() < chord2) return chords + (base + edge - from).norm() / chord;
      // |base + t edge - from| = chord; the polyline leaves the ball in this segment, by the larger root.
      const double a = edge.squaredNorm();
      const double b = edge.dot(base - from);
      const double c = (base - from).squaredNorm() - chord2;
      along = std::clamp((-b + std::sqrt(std::max(0.0, b * b - a * c))) / a, along, 1.0);
      from = base + along * edge;
      chords += 1.0;
      visit(from, arclength_[static_cast<std::size_t>(segment)] + along * std::sqrt(a));
    }
  }

 private:
  const Points& points_;
  std::vector<double> arclength_;
};

}  // namespace

std::vector<double> arclengths(const Points& points, const std::vector<int>& cuts) {
  std::vector<double> out;
  double along = 0.0;
  for (const Piece& piece : pieces_between(points.cols(), cuts))
    for (Eigen::Index i = piece.begin; i < piece.end; ++i) {
      if (i > piece.begin) along += (points.col(i) - points.col(i - 1)).norm();
      out.push_back(along);
    }
  return out;
}

Points resample_evenly(const Points& points, double edge_length, std::vector<double>* position) {
  const ChordWalk walk(points);
  const double count = std::max(1.0, std::round(walk.length() / edge_length));
  // Chords are shorter than their arcs: the number that fits falls with their length, and is bisected for.
  double low = 0.5 * (points.rightCols(1) - points.leftCols(1)).norm() / count;
  double high = walk.length() / count * (1.0 + 1e-9);
  const auto ignore = [](const Vec3&, double) {};
  for (int i = 0; i < 100 && high - low > 1e-15 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (walk.walk(middle, ignore) > count ? low : high) = middle;
  }
  const auto edges = static_cast<Eigen::Index>(count);
  Points nodes(3, edges + 1);
  std::vector<double> along(static_cast<std::size_t>(edges) + 1, walk.length());
  nodes.col(0) = points.col(0);
  along[0] = 0.0;
  Eigen::Index next = 1;
  walk.walk(high, [&](const Vec3& node, double s) {
    if (next >= edges) return;
    nodes.col(next) = node;
    along[static_cast<std::size_t>(next)] = s;
    ++next;
  });
  nodes.col(edges) = points.rightCols(1);
  if (position) *position = std::move(along);
  return nodes;
}

double EdgeGrading::operator()(double s) const {
  constexpr double kGrowth = 0.25;
  double length = coarse;
  for (const Zone& zone : zones) {
    const double away = std::max({zone.begin - s, s - zone.end, 0.0});
    length = std::min(length, zone.edge_length + kGrowth * away);
  }
  return length;
}

Points resample_graded(const Points& points, const EdgeGrading& wanted, std::vector<double>* position) {
  // Edges laid up to each point of the polyline: the integral of ds over their wanted length.
  const std::vector<double> arclength = arclengths(points);
  std::vector<double> laid{0.0};
  for (std::size_t i = 1; i < arclength.size(); ++i)
    laid.push_back(laid.back() + (arclength[i] - arclength[i - 1]) / wanted(0.5 * (arclength[i] + arclength[i - 1])));
  const double count = std::max(1.0, std::round(laid.back()));
  const auto edges = static_cast<Eigen::Index>(count);
  Points nodes(3, edges + 1);
  if (position) position->assign(static_cast<std::size_t>(edges) + 1, arclength.back());
  std::size_t next = 1;
  for (Eigen::Index i = 0; i < edges; ++i) {
    const double here = laid.back() * static_cast<double>(i) / count;
    while (laid[next] < here) ++next;
    const double t = (here - laid[next - 1]) / (laid[next] - laid[next - 1]);
    const auto p = static_cast<Eigen::Index>(next);
    nodes.col(i) = points.col(p - 1) + t * (points.col(p) - points.col(p - 1));
    if (position)
      (*position)[static_cast<std::size_t>(i)] = arclength[next - 1] + t * (arclength[next] - arclength[next - 1]);
  }
  nodes.col(edges) = points.rightCols(1);
  return nodes;
}

std::optional<std::pair<double, double>> part_near_itself(const Points& points, double near, double apart) {
  const std::vector<double> along = arclengths(points);
  std::optional<std::pair<double, double>> out;
  // The first node of each near pair comes before its second one, so the outermost of both bound the part.
  std::size_t other = 0;
  for (std::size_t i = 0; i < along.size(); ++i) {
    while (other < along.size() && along[other] - along[i] < apart) ++other;
    const auto here = static_cast<Eigen::Index>(i);
    for (std::size_t j = other; j < along.size(); ++j) {
      const Vec3 between = points.col(static_cast<Eigen::Index>(j)) - points.col(here);
      if (between.squaredNorm() >= near * near) continue;
      out = out ? std::pair(out->first, std::max(out->second, along[j])) : std::pair(along[i], along[j]);
    }
  }
  return out;
}

NearestPlaces nearest_places(const Points& points, double exclusion, const std::vector<int>& cuts,
                             const std::vector<double>& radii) {
  const Eigen::Index edges = points.cols() - 1;
  const Points edge = points.rightCols(edges) - points.leftCols(edges);
  const Points middle = 0.5 * (points.rightCols(edges) + points.leftCols(edges));
  const Eigen::VectorXd length = edge.colwise().norm();
  const std::vector<double> along = arclengths(points, cuts);
  const Eigen::Map<const Eigen::VectorXd> begin(along.data(), edges + 1);
  const double thickest = radii.empty() ? 1.0 : *std::max_element(radii.begin(), radii.end());
  Eigen::VectorXd radius = Eigen::VectorXd::Constant(edges, thickest);  // of each edge
  Eigen::VectorXi piece(edges);                                         // rope of each edge; -1: it is cut
  int number = 0;
  for (const Piece& one : pieces_between(points.cols(), cuts)) {
    if (!radii.empty()) radius.segment(one.begin, one.nodes() - 1).setConstant(radii[static_cast<std::size_t>(number)]);
    piece.segment(one.begin, one.nodes() - 1).setConstant(number++);
    if (one.end <= edges) piece[one.end - 1] = -1;
  }
  NearestPlaces best;
  best.distance = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < edges; ++i) {
    if (piece[i] < 0) continue;
    const double along_least = exclusion * (radius[i] / thickest);
    for (Eigen::Index j = i + 1; j < edges; ++j) {
      if (piece[j] < 0) continue;
      if (piece[i] == piece[j] && begin[j] - begin[i + 1] < along_least) continue;
      const double radius_deficit = 2.0 * thickest - radius[i] - radius[j];
      // Centrelines of this pair must be nearer than this for its surfaces to be the nearest ones so far.
      const double bound = best.distance + best.radius_deficit - radius_deficit;
      const double reach = std::max(bound + 0.5 * (length[i] + length[j]), 0.0);
      if ((middle.col(i) - middle.col(j)).squaredNorm() >= reach * reach) continue;
      const ClosestPoints at = closest_points(points.col(i), edge.col(i), points.col(j), edge.col(j), 0.0);
      const Vec3 gap = points.col(i) + at.t * edge.col(i) - points.col(j) - at.u * edge.col(j);
      const double distance = gap.norm();
      if (distance < bound)
        best = {distance, radius_deficit, begin[i] + at.t * length[i], begin[j] + at.u * length[j],
                points.col(j) + at.u * edge.col(j) + 0.5 * gap};
    }
  }
  return best;
}

}  // namespace knot_utm
