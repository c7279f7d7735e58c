#include "knot_utm/analysis/rate_shares.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace knot_utm {
namespace {

double drag_loss(const Sample& sample) { return sample.dissipation - sample.friction_loss; }
double difference(const Sample& sample) { return sample.force_upper - sample.force_lower; }

/// The samples of what pulls up to `furthest` and until `end`, with the one that it begins from.
std::vector<const Sample*> pull_to(const std::vector<Sample>& samples, double furthest, double end) {
  std::vector<const Sample*> out;
  const Sample* before = nullptr;
  for (const Sample& sample : samples) {
    if (sample.status == BenchStatus::kBroken || sample.time >= end) break;
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

/// Where half of the way has less.
double median_drag(const std::vector<const Sample*>& pull) {
  struct Piece {
    double drag, way;
  };
  std::vector<Piece> pieces;
  double whole = 0.0;
  for (std::size_t i = 1; i < pull.size(); ++i) {
    const double way = std::abs(pull[i]->extension - pull[i - 1]->extension);
    if (!(way > 0.0)) continue;
    pieces.push_back({(drag_loss(*pull[i]) - drag_loss(*pull[i - 1])) / way, way});
    whole += way;
  }
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.drag < b.drag; });
  double passed = 0.0;
  for (const Piece& piece : pieces) {
    passed += piece.way;
    if (passed >= 0.5 * whole) return piece.drag;
  }
  return 0.0;
}

}  // namespace

RateShares rate_shares(const std::vector<Sample>& samples, std::optional<double> lock_extension,
                       std::optional<double> untangled_at) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  RateShares out;
  const std::vector<const Sample*> pull =
      pull_to(samples, lock_extension.value_or(kNever), untangled_at.value_or(kNever));
  if (pull.size() < 2 || !(pull.back()->time > pull.front()->time)) return out;
  const double force = mean(pull, [](const Sample& sample) { return std::abs(sample.force_upper); });
  if (!(force > 0.0)) return out;
  out.drag = median_drag(pull) / force;
  const double steady = mean(pull, difference);
  out.inertia = mean(pull, [steady](const Sample& s) { return std::abs(difference(s) - steady); }) / force;
  return out;
}

}  // namespace knot_utm
