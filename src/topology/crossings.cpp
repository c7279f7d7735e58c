#include "knot_utm/topology/crossings.hpp"

#include <algorithm>

namespace knot_utm {
namespace {

using Vec2 = Eigen::Vector2d;

/// Whether c lies to the left of the line from a to b, or on it. The two segments that share a node get the same answer
/// for it, so that a crossing there is found exactly once.
bool left_of(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x()) >= 0.0;
}

struct Box {
  Vec2 low, high;

  bool apart_from(const Box& other) const {
    return low.x() > other.high.x() || other.low.x() > high.x() || low.y() > other.high.y() || other.low.y() > high.y();
  }
};

Box around(const Box& a, const Box& b) { return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)}; }

/// A closed polygon as seen from a viewing direction, with boxes around its segments, around each two neighbouring
/// boxes, and so on up to one around all.
struct View {
  View(const Points& polygon, const Mat3& rotation) : points(rotation * polygon), n(polygon.cols()), boxes(1) {
    for (Eigen::Index i = 0; i < n; ++i) boxes[0].push_back({at(i).cwiseMin(at(i + 1)), at(i).cwiseMax(at(i + 1))});
    while (boxes.back().size() > 1) {
      const std::vector<Box>& small = boxes.back();
      std::vector<Box> large;
      for (std::size_t i = 0; i < small.size(); i += 2)
        large.push_back(around(small[i], small[std::min(i + 1, small.size() - 1)]));
      boxes.push_back(std::move(large));
    }
  }
  Vec2 at(Eigen::Index i) const { return points.col(i == n ? 0 : i).head<2>(); }
  double depth(Eigen::Index segment, double fraction) const {
    const double a = points(2, segment);
    const double b = points(2, segment + 1 == n ? 0 : segment + 1);
    return a + fraction * (b - a);
  }

  Points points;
  Eigen::Index n;
  std::vector<std::vector<Box>> boxes;  // [level][i]: around segments i 2^level to (i + 1) 2^level - 1
};

/// One box of a view, which stands for all segments in it.
struct Piece {
  const View* view;
  std::size_t level, i;

  bool exists() const { return i < view->boxes[level].size(); }
  const Box& box() const { return view->boxes[level][i]; }
  Piece half(std::size_t k) const { return {view, level - 1, 2 * i + k}; }
};

Piece whole(const View& view) { return {&view, view.boxes.size() - 1, 0}; }

/// Calls visit(segment of a, segment of b) for all pairs whose boxes overlap.
template <typename Visit>
void meet(const Piece& a, const Piece& b, const Visit& visit) {
  if (!a.exists() || !b.exists() || a.box().apart_from(b.box())) return;
  if (a.level == 0 && b.level == 0) {
    visit(static_cast<Eigen::Index>(a.i), static_cast<Eigen::Index>(b.i));
    return;
  }
  for (std::size_t k = 0; k < 2; ++k) {
    if (a.level >= b.level)
      meet(a.half(k), b, visit);
    else
      meet(a, b.half(k), visit);
  }
}

/// Calls visit(i, j), i < j, for all pairs of segments of a piece whose boxes overlap.
template <typename Visit>
void meet_itself(const Piece& piece, const Visit& visit) {
  if (!piece.exists() || piece.level == 0) return;
  meet_itself(piece.half(0), visit);
  meet_itself(piece.half(1), visit);
  meet(piece.half(0), piece.half(1), visit);
}

/// Adds the crossing of segment i of one view with segment j of another, if there is one.
void cross(const View& first, Eigen::Index i, const View& second, Eigen::Index j, std::vector<Crossing>& crossings) {
  const Vec2 a = first.at(i);
  const Vec2 b = first.at(i + 1);
  const Vec2 c = second.at(j);
  const Vec2 d = second.at(j + 1);
  const bool to_left = left_of(a, b, d);
  if (left_of(a, b, c) == to_left || left_of(c, d, a) == left_of(c, d, b)) return;
  const Vec2 u = b - a;
  const Vec2 v = d - c;
  const Vec2 w = c - a;
  const double area = u.x() * v.y() - u.y() * v.x();
  const double s = std::clamp((w.x() * v.y() - w.y() * v.x()) / area, 0.0, 1.0);
  const double t = std::clamp((w.x() * u.y() - w.y() * u.x()) / area, 0.0, 1.0);
  const bool first_over = first.depth(i, s) > second.depth(j, t);
  const bool positive = to_left == first_over;
  crossings.push_back(first_over ? Crossing{i, j, s, t, positive, true} : Crossing{j, i, t, s, positive, false});
}

}  // namespace

std::vector<Crossing> crossings_of(const Points& polygon, const Mat3& rotation) {
  const View view(polygon, rotation);
  std::vector<Crossing> crossings;
  meet_itself(whole(view), [&](Eigen::Index i, Eigen::Index j) {
    const bool share_a_point = j == i + 1 || (i == 0 && j == view.n - 1);
    if (!share_a_point) cross(view, i, view, j, crossings);
  });
  return crossings;
}

std::vector<Crossing> crossings_between(const Points& first, const Points& second, const Mat3& rotation) {
  const View a(first, rotation), b(second, rotation);
  std::vector<Crossing> crossings;
  meet(whole(a), whole(b), [&](Eigen::Index i, Eigen::Index j) { cross(a, i, b, j, crossings); });
  return crossings;
}

namespace {

// A turning point counts once the strand has come back from it by this height; even a tight coil is longer [h].
constexpr double kTurn = 1.5;

}  // namespace

OverhandStrand OverhandStrand::follow(const Points& points, std::size_t k, Eigen::Index standing, const Vec3& axis,
                                      double radius, int windings, int passed_over) {
  const Eigen::Index step = k == 0 ? -1 : 1;
  const double turn = kTurn * radius;
  const auto height = [&](Eigen::Index i) { return static_cast<double>(step) * points.col(i).dot(axis); };
  OverhandStrand strand;
  strand.begin = strand.top = standing;
  strand.cut = strand.end = k == 0 ? 0 : points.cols() - 1;
  double lowest = height(standing), highest = lowest, bottom = lowest, leaving = 0.0;
  const int rises = std::max(own_rises(windings), passed_over);  // of the coil
  int aslant = rises;                                            // left
  enum { kRising, kFalling, kLeaving } part = kRising;
  for (Eigen::Index i = standing; i != strand.end + step; i += step) {
    const double z = height(i);
    if (part == kRising) {
      const bool rose = highest > lowest + turn;
      if (z > highest) {
        highest = z;
        strand.top = i;
      } else if (z < highest - turn && rose) {
        part = kFalling;
        bottom = z;
      } else if (z < lowest && !rose) {
        lowest = highest = z;
        strand.begin = strand.top = i;
      }
    } else if (part == kFalling) {
      bottom = std::min(bottom, z);
      if (z > bottom + turn) {
        part = kLeaving;
        leaving = z;
        strand.cut = i;
      }
    } else {
      if (z > leaving) {
        leaving = z;
        strand.cut = i;
      }
      if (z > highest + radius && passed_over <= 0) break;
      if (z < leaving - turn) {
        if (aslant-- == 0) break;
        if (passed_over-- > 0) highest = std::max(highest, leaving);
        part = kFalling;
        bottom = z;
      }
    }
  }
  strand.coil_found = part == kLeaving || aslant < rises;
  strand.level = std::max(highest + radius, height(strand.cut));
  return strand;
}

}  // namespace knot_utm
