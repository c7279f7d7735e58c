#include "knot_utm/analysis/rate_shares.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace knot_utm {
namespace {

double drag_loss(const Sample& sample) { return sample.dissipation - sample.friction_loss; }
double difference(const Sample& sample) { return sample.force_upper - sample.force_lower; }

/// The samples of the first pull up to `furthest`, with the one that it begins from.
std::vector<const Sample*> pull_to(const std::vector<Sample>& samples, double furthest) {
  std::vector<const Sample*> out;
  const Sample* before = nullptr;
  for (const Sample& sample : samples) {
    if (sample.status == BenchStatus::kBroken) break;
    if (pulls(sample.phase)) {
      if (sample.extension > furthest) break;
      if (out.empty() && before) out.push_back(before);
      out.push_back(&sample);
    }
    before = &sample;
  }
  return out;
}

/// Mean over time of `value`, as it is at the end of each step.
template <class Value>
double mean(const std::vector<const Sample*>& pull, const Value& value) {
  double sum = 0.0;
  for (std::size_t i = 1; i < pull.size(); ++i) sum += (pull[i]->time - pull[i - 1]->time) * value(*pull[i]);
  return sum / (pull.back()->time - pull.front()->time);
}

}  // namespace

RateShares rate_shares(const std::vector<Sample>& samples, std::optional<double> lock_extension) {
  RateShares out;
  const std::vector<const Sample*> pull =
      pull_to(samples, lock_extension.value_or(std::numeric_limits<double>::infinity()));
  if (pull.size() < 2 || !(pull.back()->time > pull.front()->time)) return out;
  const Sample &first = *pull.front(), &last = *pull.back();
  const double work = last.grip_work - first.grip_work;
  if (work > 0.0) out.drag = (drag_loss(last) - drag_loss(first)) / work;
  const double force = mean(pull, [](const Sample& sample) { return std::abs(sample.force_upper); });
  const double steady = mean(pull, difference);
  if (force > 0.0)
    out.inertia = mean(pull, [steady](const Sample& s) { return std::abs(difference(s) - steady); }) / force;
  return out;
}

}  // namespace knot_utm
