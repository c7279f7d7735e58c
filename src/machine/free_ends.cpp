#include "knot_utm/machine/free_ends.hpp"

#include <cmath>

namespace knot_utm {

namespace {

constexpr double kOutside = 0.05;  // of a rope's normal force: what lies before it is the tail

}  // namespace

FreeEnds::FreeEnds(const Centreline& centreline, const RodProperties& rod) : arclength_(rod.arclength()) {
  int first = 0;
  const auto add_rope = [&](int last) {
    ropes_.push_back({first, last});
    for (const int end : centreline.free) {
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
  // The force of a node is spread over the edge before it.
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

}  // namespace knot_utm
