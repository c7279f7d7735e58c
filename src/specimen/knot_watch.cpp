#include "knot_utm/specimen/knot_watch.hpp"

#include <stdexcept>

namespace knot_utm {

KnotWatch::KnotWatch(const std::vector<int>& standing_nodes, double radius, const Points& start, int windings)
    : radius_(radius) {
  if (standing_nodes.size() == 2) loop_.emplace(standing_nodes[0], standing_nodes[1], radius, windings);
  start_ = read(start);
}

KnotType KnotWatch::follow(const Points& points) {
  const bool for_good = type_ == KnotType::kCrossed || (type_ == KnotType::kChanged && !loop_);
  if (for_good) return type_;
  if ((points - last_).colwise().squaredNorm().maxCoeff() < radius_ * radius_) return type_;
  try {
    const LoopTopology::Reading now = read(points);
    // A rod that began without a knot cannot lose it, but joining the ends of an arch or a helix may make one.
    const bool unknotted = !loop_ && start_.polynomial == KnotPolynomial{1};
    type_ = unknotted || now.same_knot(start_) ? KnotType::kKept : KnotType::kChanged;
  } catch (const std::runtime_error&) {
    type_ = KnotType::kCrossed;
  }
  return type_;
}

void KnotWatch::state(Archive& archive) {
  archive.section("KNOT");
  archive.choice("knot type", type_, KnotType::kCrossed);
  archive(last_, readings_);
  if (loop_) archive(*loop_);
}

LoopTopology::Reading KnotWatch::read(const Points& points) {
  last_ = points;
  ++readings_;
  if (loop_) return readings_ == 1 ? loop_->read(points, Vec3::UnitZ()) : loop_->read_as(start_, points, Vec3::UnitZ());
  LoopTopology::Reading reading;
  const Vec3 axis = points.rightCols(1) - points.leftCols(1);
  reading.polynomial = alexander_polynomial(closed_far_away(points, axis));
  return reading;
}

}  // namespace knot_utm
