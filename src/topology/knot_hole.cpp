#include "knot_utm/topology/knot_hole.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "knot_utm/rod/frames.hpp"
#include "knot_utm/topology/crossings.hpp"

namespace knot_utm {

void LoopTurn::add(const Points& shape) {
  // A knot, or a tail that swings, may stand out further than the strand on a roller.
  const Eigen::Index knotted = shape.cols() / 5, between = shape.cols() - 2 * knotted;
  Eigen::Index highest = 0, lowest = 0;
  shape.row(2).segment(knotted, between).maxCoeff(&highest);
  shape.row(2).segment(knotted, between).minCoeff(&lowest);
  highest += knotted;
  lowest += knotted;
  double length = 0.0, sum = 0.0;
  for (Eigen::Index i = 0; i < shape.cols(); ++i) {
    if (i > 0) length += (shape.col(i) - shape.col(i - 1)).norm();
    if (i == highest || i == lowest) sum += length;
  }
  const double middle = 0.5 * (sum - length);
  if (!first_) first_ = middle;
  largest_ = std::max(largest_, std::abs(middle - *first_));
}

namespace {

constexpr int kViews = 400;          // evenly over half of all directions: the other half gives the same views
constexpr std::size_t kBest = 8;     // number of views that are turned further
constexpr double kFirstTurn = 0.1;   // half of the angle between neighbouring views [rad]
constexpr double kLastTurn = 1e-3;   // [rad]
constexpr double kWorthATurn = 0.8;  // of the largest circle so far: smaller ones do not become the largest by a turn
constexpr double kFirstTolerance = 0.05;  // [h]
constexpr double kTolerance = 1e-3;       // [h]

/// The piece of the curve from one visit of a crossing to the next: a closed loop.
struct Loop {
  Eigen::Index first, last;  ///< segments: it begins on the one and ends on the other
  Eigen::Vector2d crossing;
};

/// Contribution of the segment from a to b to the winding number around p: 1 or -1 if it crosses the ray from p to the
/// right.
int passes(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p) {
  if ((a.y() > p.y()) == (b.y() > p.y())) return 0;
  const double side = (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
  const bool rises = b.y() > a.y();
  return rises == (side > 0.0) ? (rises ? 1 : -1) : 0;
}

/// A curve as it is seen from one direction.
class HoleView {
 public:
  HoleView(const Points& points, const Mat3& rotation) : points_(rotation.topRows<2>() * points) {
    turns_.assign(static_cast<std::size_t>(points.cols()), 0);
    for (const Crossing& crossing : crossings_of(points, rotation)) {
      const bool over_first = crossing.over < crossing.under;
      const Eigen::Index first = over_first ? crossing.over : crossing.under;
      const Eigen::Index last = over_first ? crossing.under : crossing.over;
      if (last + 1 == points.cols()) continue;  // the segment that closes the polygon is no part of the curve
      const double at = over_first ? crossing.over_fraction : crossing.under_fraction;
      loops_.push_back({first, last, (1.0 - at) * points_.col(first) + at * points_.col(first + 1)});
      box(loops_.back());
    }
    if (has_loops()) keep_near_segments();
  }

  bool has_loops() const { return !loops_.empty(); }
  const Eigen::Vector2d& low() const { return low_; }
  const Eigen::Vector2d& high() const { return high_; }

  /// Distance to the curve near its loops, negative where it does not enclose p. A curve encloses p if one of its loops
  /// winds around p.
  double signed_distance(const Eigen::Vector2d& p) {
    double least = std::numeric_limits<double>::infinity();
    for (const Segment& segment : near_) {
      const Eigen::Vector2d from = p - segment.begin;
      const double at = std::clamp(from.dot(segment.along) * segment.over_squared_length, 0.0, 1.0);
      least = std::min(least, (from - at * segment.along).squaredNorm());
    }
    count_turns(p);
    return encloses(p) ? std::sqrt(least) : -std::sqrt(least);
  }

 private:
  void box(const Loop& loop) {
    const auto arc = points_.middleCols(loop.first, loop.last - loop.first + 2);
    low_ = low_.cwiseMin(arc.rowwise().minCoeff());
    high_ = high_.cwiseMax(arc.rowwise().maxCoeff());
    begin_ = std::min(begin_, loop.first);
    end_ = std::max(end_, loop.last);
  }

  /// Keeps the segments that a circle enclosed by the loops could touch.
  void keep_near_segments() {
    const double reach = 0.5 * (high_ - low_).minCoeff();
    for (Eigen::Index i = 0; i + 1 < points_.cols(); ++i) {
      const Eigen::Vector2d a = points_.col(i), b = points_.col(i + 1);
      if ((a.cwiseMin(b).array() > high_.array() + reach).any() || (a.cwiseMax(b).array() < low_.array() - reach).any())
        continue;
      near_.push_back({a, b - a, 1.0 / std::max((b - a).squaredNorm(), std::numeric_limits<double>::min())});
    }
  }

  void count_turns(const Eigen::Vector2d& p) {
    for (Eigen::Index i = begin_; i < end_; ++i)
      turns_[static_cast<std::size_t>(i) + 1] =
          turns_[static_cast<std::size_t>(i)] + passes(points_.col(i), points_.col(i + 1), p);
  }

  bool encloses(const Eigen::Vector2d& p) const {
    return std::any_of(loops_.begin(), loops_.end(), [&](const Loop& loop) {
      const int between =
          turns_[static_cast<std::size_t>(loop.last)] - turns_[static_cast<std::size_t>(loop.first) + 1];
      return passes(loop.crossing, points_.col(loop.first + 1), p) + between +
                 passes(points_.col(loop.last), loop.crossing, p) !=
             0;
    });
  }

  struct Segment {
    Eigen::Vector2d begin, along;
    double over_squared_length;  ///< 1/|along|^2
  };

  Eigen::Matrix2Xd points_;
  std::vector<Segment> near_;
  std::vector<Loop> loops_;
  Eigen::Index begin_ = std::numeric_limits<Eigen::Index>::max(), end_ = 0;  ///< segments in which all loops lie
  Eigen::Vector2d low_ = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high_ = -low_;
  std::vector<int> turns_;  ///< around the last p, from the first loop's beginning to each point; 0 there
};

/// A square of the view, and how large a circle with its centre in there could be at most.
struct Cell {
  Eigen::Vector2d centre;
  double half, most;

  bool operator<(const Cell& other) const { return most < other.most; }
};

/// View directions at even spacing, by the golden angle.
Vec3 direction(int view) {
  const double z = (view + 0.5) / kViews, across = std::sqrt(1.0 - z * z), angle = M_PI * (3.0 - std::sqrt(5.0)) * view;
  return {across * std::cos(angle), across * std::sin(angle), z};
}

Mat3 seen_along(const Vec3& direction) {
  const Vec3 right = any_normal(direction);
  Mat3 rotation;
  rotation << right.transpose(), direction.cross(right).transpose(), direction.transpose();
  return rotation;
}

struct Seen {
  Vec3 along;
  double radius;
};

/// Turns the view in four directions until that no longer widens the hole.
double widest_around(const Points& points, Seen best, double tolerance) {
  for (double turn = kFirstTurn; turn > kLastTurn;) {
    const Vec3 right = any_normal(best.along), up = best.along.cross(right);
    bool wider = false;
    for (const Vec3& to : {right, Vec3(-right), up, Vec3(-up)}) {
      const Vec3 along = (best.along + turn * to).normalized();
      const double radius =
          largest_enclosed_circle(points, seen_along(along), tolerance, best.radius + tolerance).radius;
      if (radius == 0.0) continue;
      best = {along, radius};
      wider = true;
      break;
    }
    if (!wider) turn *= 0.5;
  }
  return best.radius;
}

}  // namespace

EnclosedCircle largest_enclosed_circle(const Points& points, const Mat3& rotation, double tolerance,
                                       double larger_than) {
  EnclosedCircle best;
  if (points.cols() < 4) return best;  // three segments are the fewest of which two can cross
  HoleView view(points, rotation);
  if (!view.has_loops()) return best;
  std::priority_queue<Cell> cells;
  // Within a square the distance grows by at most half its diagonal from the centre.
  const auto add = [&](const Eigen::Vector2d& centre, double half) {
    const double radius = view.signed_distance(centre);
    if (radius > std::max(best.radius, larger_than)) best = {centre, radius};
    cells.push({centre, half, radius + std::sqrt(2.0) * half});
  };
  const Eigen::Vector2d size = view.high() - view.low(), middle = 0.5 * (view.low() + view.high());
  add(middle, 0.5 * size.maxCoeff());
  while (!cells.empty() && cells.top().most > std::max(best.radius, larger_than) + tolerance) {
    const Cell cell = cells.top();
    cells.pop();
    const double half = 0.5 * cell.half;
    for (const double x : {-half, half})
      for (const double y : {-half, half}) add(cell.centre + Eigen::Vector2d(x, y), half);
  }
  return best;
}

double hole_diameter(const Points& points, double radius) {
  const double tolerance = kTolerance * radius;
  std::vector<Seen> seen;
  double best = radius;  // a smaller circle has no room for the rod itself
  for (int i = 0; i < kViews; ++i) {
    const Vec3 along = direction(i);
    seen.push_back(
        {along,
         largest_enclosed_circle(points, seen_along(along), kFirstTolerance * radius, kWorthATurn * best).radius});
    best = std::max(best, seen.back().radius);
  }
  std::partial_sort(seen.begin(), seen.begin() + kBest, seen.end(),
                    [](const Seen& a, const Seen& b) { return a.radius > b.radius; });
  double widest = 0.0;
  for (std::size_t i = 0; i < kBest; ++i)
    if (seen[i].radius > 0.0) widest = std::max(widest, widest_around(points, seen[i], tolerance));
  return 2.0 * std::max(0.0, widest - radius);
}

}  // namespace knot_utm
