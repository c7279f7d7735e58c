#include "knot_utm/analysis/rate_shares.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "knot_utm/record/phase.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {
namespace {

double drag_loss(const Sample& sample) { return sample.dissipation - sample.friction_loss - sample.plastic_loss; }
double motion(const Sample& sample) { return sample.kinetic_energy; }
double numerical_loss(const Sample& sample) { return sample.numerical_dissipation; }

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

/// Mean over time of |F|, as it is at the end of each step.
double mean_force(const std::vector<const Sample*>& pull) {
  double sum = 0.0;
  for (std::size_t i = 1; i < pull.size(); ++i)
    sum += (pull[i]->time - pull[i - 1]->time) * std::abs(pull[i]->force_upper);
  return sum / (pull.back()->time - pull.front()->time);
}

/// |change of `energy`| on a way, over that way: half of the way has less [N].
double median_force(const std::vector<const Sample*>& pull, double (*energy)(const Sample&)) {
  struct Piece {
    double force, way;
  };
  std::vector<Piece> pieces;
  double whole = 0.0;
  for (std::size_t i = 1; i < pull.size(); ++i) {
    const double way = std::abs(pull[i]->extension - pull[i - 1]->extension);
    if (!(way > 0.0)) continue;
    pieces.push_back({std::abs(energy(*pull[i]) - energy(*pull[i - 1])) / way, way});
    whole += way;
  }
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.force < b.force; });
  double passed = 0.0;
  for (const Piece& piece : pieces) {
    passed += piece.way;
    if (passed >= 0.5 * whole) return piece.force;
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
  const double force = mean_force(pull);
  if (!(force > 0.0)) return out;
  out.drag = median_force(pull, drag_loss) / force;
  out.inertia = median_force(pull, motion) / force;
  out.numerical = median_force(pull, numerical_loss) / force;
  return out;
}

}  // namespace knot_utm
