#include "knot_utm/analysis/sample_readings.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "knot_utm/program/phases.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {
namespace {

double drag_loss(const Sample& sample) { return sample.dissipation - sample.friction_loss - sample.plastic_loss; }
double motion(const Sample& sample) { return sample.kinetic_energy; }
double numerical_loss(const Sample& sample) { return sample.numerical_dissipation; }

/// Samples that pull, up to the extension `furthest` and the time `end`, after the sample before the first one.
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

/// Mean of |F| over time; each step counts with F at its end.
double mean_force(const std::vector<const Sample*>& pull) {
  double sum = 0.0;
  for (std::size_t i = 1; i < pull.size(); ++i)
    sum += (pull[i]->time - pull[i - 1]->time) * std::abs(pull[i]->force_upper);
  return sum / (pull.back()->time - pull.front()->time);
}

/// Median of |change of `energy`|/|change of s|, weighted by the change of s [N].
double median_force(const std::vector<const Sample*>& pull, double (*energy)(const Sample&)) {
  struct Piece {
    double force, extension;
  };
  std::vector<Piece> pieces;
  double whole = 0.0;
  for (std::size_t i = 1; i < pull.size(); ++i) {
    const double extension = std::abs(pull[i]->extension - pull[i - 1]->extension);
    if (!(extension > 0.0)) continue;
    pieces.push_back({std::abs(energy(*pull[i]) - energy(*pull[i - 1])) / extension, extension});
    whole += extension;
  }
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.force < b.force; });
  double passed = 0.0;
  for (const Piece& piece : pieces) {
    passed += piece.extension;
    if (passed >= 0.5 * whole) return piece.force;
  }
  return 0.0;
}

constexpr double kLeft = 0.9;      // force after a snap over that before, at most
constexpr double kGivenUp = 0.02;  // energy given up over the stored one, at least
constexpr double kPutIn = 0.5;     // work of the grips over the energy given up, at most

struct Instant {
  double extension, force, stored, work;
};

/// Time steps of pulls that reach a new largest extension, up to a break, one list for each motion outwards: if the
/// crosshead went back or stood in between, the load may have fallen then.
std::vector<std::vector<Instant>> pulled(const std::vector<Sample>& samples) {
  std::vector<std::vector<Instant>> out;
  double furthest = -std::numeric_limits<double>::infinity();
  bool goes_on = false;
  const Sample* before = nullptr;
  for (const Sample& sample : samples) {
    if (sample.status == BenchStatus::kBroken) break;
    const bool outwards = pulls(sample.phase) && !(before && sample.displacement < before->displacement);
    before = &sample;
    if (!outwards) goes_on = false;
    if (!outwards || !(sample.extension > furthest)) continue;
    furthest = sample.extension;
    if (!std::exchange(goes_on, true)) out.emplace_back();
    out.back().push_back({furthest, sample.force_upper, stored_energy(sample), sample.grip_work});
  }
  return out;
}

bool snaps(const Instant& start, const Instant& before, const Instant& after) {
  const double given_up = before.stored - after.stored;
  return after.force <= kLeft * before.force && given_up >= kGivenUp * before.stored &&
         after.work - before.work <= kPutIn * given_up && after.stored >= start.stored;
}

void keep_larger_snap(const std::vector<Instant>& pull, std::optional<Snap>& out) {
  for (std::size_t i = 0; i < pull.size(); ++i) {
    const Instant& before = pull[i];
    if (!(before.force > 0.0)) continue;
    // A snap gives up at most the energy above that at the start.
    const double most = kPutIn * (before.stored - pull.front().stored);
    for (std::size_t j = i + 1; j < pull.size() && pull[j].work - before.work <= most; ++j) {
      const double drop = before.force - pull[j].force;
      if (!(out && drop <= out->drop) && snaps(pull.front(), before, pull[j])) out = Snap{before.extension, drop};
    }
  }
}

// The start of a pull as a fraction of its extension, by choice: the wave from its first jerk has crossed the specimen
// by then.
constexpr double kStart = 0.01;

}  // namespace

double stored_energy(const Sample& sample) {
  return sample.stretching_energy + sample.bending_energy + sample.twisting_energy + sample.contact_energy;
}

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

std::optional<Snap> snap(const std::vector<Sample>& samples) {
  std::optional<Snap> out;
  for (const std::vector<Instant>& pull : pulled(samples)) keep_larger_snap(pull, out);
  return out;
}

std::optional<GripForces> forces_at_start(const std::vector<Sample>& samples) {
  const auto first =
      std::find_if(samples.begin(), samples.end(), [](const Sample& sample) { return pulls(sample.phase); });
  if (first == samples.end()) return std::nullopt;
  double end = first->extension;
  for (auto sample = first; sample != samples.end(); ++sample)
    if (pulls(sample->phase)) end = std::max(end, sample->extension);
  const double near = first->extension + kStart * (end - first->extension);
  // If it was balanced in between, the extension before the pull has another zero.
  const Sample& before = first == samples.begin() ? *first : *(first - 1);
  GripForces most{before.force_upper, before.force_lower};
  for (auto sample = first; sample != samples.end() && sample->extension <= near; ++sample) {
    if (sample->status == BenchStatus::kBroken) break;
    const GripForces now{sample->force_upper, sample->force_lower};
    if (now.difference() > most.difference()) most = now;
  }
  return most;
}

}  // namespace knot_utm
