#include "knot_utm/machine/knot_readings.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "knot_utm/contact/closest_points.hpp"

namespace knot_utm {

namespace {

constexpr double kMeeting = 1.05;              // distance of strands that touch [both radii]
constexpr double kOwnNeighbours = 1.5 * M_PI;  // of rod between places that may touch [radius of the thickest rope]
constexpr int kHalvings = 40;

/// The least t from which on p + t a is within `reach` of the edge from q to q + b, up to where it is nearest; 1:
/// never. The distance is a convex function of t.
double first_within(double reach, const Vec3& p, const Vec3& a, const Vec3& q, const Vec3& b) {
  const ClosestPoints nearest = closest_points(p, a, q, b, 0.0);
  if ((p + nearest.t * a - q - nearest.u * b).norm() >= reach) return 1.0;
  const auto within = [&](double t) {
    const Vec3 x = p + t * a - q;
    return (x - std::clamp(x.dot(b) / b.squaredNorm(), 0.0, 1.0) * b).norm() < reach;
  };
  if (within(0.0)) return 0.0;
  double outside = 0.0, inside = nearest.t;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (outside + inside);
    (within(middle) ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace

KnotReadings::KnotReadings(const Centreline& centreline, const RodProperties& rod)
    : read_(centreline.read), arclength_(rod.arclength()), radius_(rod.edges()) {
  for (Eigen::Index j = 0; j < rod.edges(); ++j) radius_[j] = rod.is_cut(j) ? 0.0 : rod.material_at(j).radius;
}

KnotReadings::Shape KnotReadings::shape_of(const Points& position) const {
  const Eigen::Index edges = radius_.size();
  const Points along = 0.5 * (position.rightCols(edges) - position.leftCols(edges));
  Shape out{position, position.leftCols(edges) + along, along.colwise().norm(), {}};
  for (int j = 0; j < edges; ++j)
    if (radius_[j] > 0.0) {
      out.by_height.push_back(j);
      out.longest = std::max(out.longest, out.half_length[j]);
    }
  std::sort(out.by_height.begin(), out.by_height.end(),
            [&](int a, int b) { return out.middle(2, a) < out.middle(2, b); });
  return out;
}

double KnotReadings::first_touch(int node, int step, const Shape& shape) const {
  const auto edges = static_cast<int>(radius_.size());
  const double thickest = radius_.maxCoeff(), apart = kOwnNeighbours * thickest;
  const auto along = [&](int j) { return 0.5 * (arclength_[j] + arclength_[j + 1]); };
  for (int i = step > 0 ? node : node - 1; i >= 0 && i < edges && radius_[i] > 0.0; i += step) {
    const int from = step > 0 ? i : i + 1, to = from + step;
    const Vec3 p = shape.position.col(from), a = shape.position.col(to) - p, middle = shape.middle.col(i);
    const double farthest = kMeeting * (radius_[i] + thickest) + shape.half_length[i] + shape.longest;
    const auto lowest = std::lower_bound(shape.by_height.begin(), shape.by_height.end(), middle[2] - farthest,
                                         [&](int j, double height) { return shape.middle(2, j) < height; });
    double first = 1.0;
    for (auto other = lowest; other != shape.by_height.end(); ++other) {
      const int j = *other;
      if (shape.middle(2, j) > middle[2] + farthest) break;
      const double reach = kMeeting * (radius_[i] + radius_[j]),
                   near = reach + shape.half_length[i] + shape.half_length[j];
      if ((shape.middle.col(j) - middle).squaredNorm() > near * near || std::abs(along(j) - along(i)) < apart) continue;
      const Vec3 q = shape.position.col(j), b = shape.position.col(j + 1) - q;
      first = std::min(first, first_within(reach, p, a, q, b));
    }
    if (first < 1.0) return arclength_[from] + first * (arclength_[to] - arclength_[from]);
  }
  return PerKnot::kUnknown;
}

PerKnot KnotReadings::at(const Points& position) const {
  PerKnot out = PerKnot::unknown(read_.size());
  const Shape shape = shape_of(position);
  for (std::size_t k = 0; k < read_.size(); ++k) {
    const auto [low, high] = std::minmax(read_[k].first, read_[k].second);
    switch (read_[k].kind) {
      case KnotReading::Kind::kLoop:
        out[k] = first_touch(low, 1, shape) - first_touch(low, -1, shape);
        break;
      case KnotReading::Kind::kBetween:
        // Both landmarks may lie in one loop; then nothing lies between. What is unknown stays so.
        out[k] = first_touch(high, -1, shape) - first_touch(low, 1, shape);
        if (out[k] < 0.0) out[k] = 0.0;
        break;
      case KnotReading::Kind::kDistance:
        out[k] = (position.col(high) - position.col(low)).norm();
        break;
    }
  }
  return out;
}

}  // namespace knot_utm
