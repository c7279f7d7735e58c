#include "knot_utm/machine/free_ends.hpp"

#include <cmath>

namespace knot_utm {

namespace {

constexpr double kOutside = 0.05;  // of a rope's normal force: what lies before it is the tail

}  // namespace

FreeEnds::FreeEnds(const Centreline& centreline, const RodProperties& rod) : arclength_(rod.arclength()) {
  int first = 0;
  const auto add_rope = [&](int last) {
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

PerKnot FreeEnds::lengths(const Eigen::VectorXd& strands, const Eigen::VectorXd& all) const {
  PerKnot out = PerKnot::unknown(tails_.size());
  for (std::size_t k = 0; k < tails_.size(); ++k) out[k] = length(tails_[k], touched_ ? strands : all);
  return out;
}

}  // namespace knot_utm
