#include "knot_utm/specimen/knot_readings.hpp"

#include <algorithm>
#include <cmath>

#include "knot_utm/contact/closest_points.hpp"
#include "knot_utm/topology/crossings.hpp"

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

constexpr double kOutside = 0.05;  // share of a rope's normal force at which its tail ends

NodeRange between(Eigen::Index a, Eigen::Index b) {
  return {static_cast<int>(std::min(a, b)), static_cast<int>(std::max(a, b))};
}

}  // namespace

KnotReadings::KnotReadings(const Centreline& centreline, const RodProperties& rod)
    : read_(centreline.readings), arclength_(rod.arclength()), radius_(rod.edges()) {
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

FreeEnds::FreeEnds(const Centreline& centreline, const RodProperties& rod) : arclength_(rod.arclength()) {
  int first = 0;
  const auto add_rope = [&](int last) {
    ropes_.push_back({first, last});
    for (const int end : centreline.free_ends) {
      if (end == first) tails_.push_back({first, last, 1});
      if (end == last) tails_.push_back({last, first, -1});
    }
    first = last + 1;
  };
  for (const int cut : centreline.cuts) add_rope(cut);
  add_rope(static_cast<int>(rod.nodes()) - 1);
  if (tails_.size() > PerKnot::kMost) tails_.resize(PerKnot::kMost);
}

double FreeEnds::length(const Tail& tail, const Eigen::VectorXd& normal_force) const {
  double total = 0.0;
  for (int i = tail.begin; i != tail.end + tail.step; i += tail.step) total += normal_force[i];
  const double borne = kOutside * total;
  if (!(borne > 0.0)) return PerKnot::kUnknown;
  double sum = 0.0;
  int i = tail.begin;
  while (sum + normal_force[i] < borne) sum += normal_force[i], i += tail.step;
  // The force of a node counts as spread over the edge before it.
  const double part = (borne - sum) / normal_force[i], at = arclength_[i],
               before = i == tail.begin ? at : arclength_[i - tail.step];
  return std::abs(before + part * (at - before) - arclength_[tail.begin]);
}

bool FreeEnds::ropes_touch(const StepReadings& readings) const {
  for (auto one = ropes_.begin(); one != ropes_.end(); ++one)
    for (auto other = ropes_.begin(); other != one; ++other)
      if (readings.normal_force_between(*one, *other) > 0.0) return true;
  return false;
}

PerKnot FreeEnds::lengths(const StepReadings& readings) const {
  PerKnot out = PerKnot::unknown(tails_.size());
  if (ropes_.size() > 1 && touched_ && !ropes_touch(readings)) return out;
  const Eigen::VectorXd force = touched_ ? readings.strand_normal_forces() : readings.normal_forces();
  for (std::size_t k = 0; k < tails_.size(); ++k) out[k] = length(tails_[k], force);
  return out;
}

KnotTouch::KnotTouch(const std::vector<int>& standing, double radius, int windings)
    : standing_{standing.at(0), standing.at(1)}, radius_(radius), windings_(windings) {}

void KnotTouch::follow(const TimeStep& stepper) {
  const Points& points = stepper.state().position;
  on_rollers_ = 0.0;
  for (std::size_t k = 0; k < 2; ++k) {
    const OverhandStrand strand = OverhandStrand::follow(points, k, standing_[k], Vec3::UnitZ(), radius_, windings_);
    if (strand.coil_found) coil_[k] = between(strand.top, strand.cut);
    if (coil_[k].empty()) continue;
    const int last = static_cast<int>(points.cols()) - 1;
    on_rollers_ +=
        stepper.readings().roller_normal_force(k == 0 ? NodeRange{0, coil_[k].last} : NodeRange{coil_[k].first, last});
  }
  between_knots_ = stepper.readings().normal_force_between(coil_[0], coil_[1]);
}

void KnotTouch::state(Archive& archive) {
  archive.section("TOUC");
  for (NodeRange& coil : coil_) archive(coil.first, coil.last);
  archive(between_knots_, on_rollers_);
}

}  // namespace knot_utm
