#include "knot_utm/analysis/results.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace knot_utm {
namespace {

using Pull = MotionPatternTracker::Pull;

std::optional<double> known(double value) { return std::isfinite(value) ? std::optional<double>(value) : std::nullopt; }

/// Means over extension, by the trapezoidal rule, of what lies between two extensions.
struct Plateau {
  double width = 0.0, force = 0.0, square = 0.0, distance_change = 0.0;
};

Plateau plateau_between(const std::vector<Pull>& pull, double low, double high) {
  Plateau plateau;
  for (std::size_t i = 1; i < pull.size(); ++i) {
    const Pull& a = pull[i - 1];
    const Pull& b = pull[i];
    const double from = std::max(a.extension, low);
    const double to = std::min(b.extension, high);
    if (!(to > from)) continue;
    const double part = (to - from) / (b.extension - a.extension);
    plateau.width += to - from;
    plateau.force += (to - from) * 0.5 * (a.force + b.force);
    plateau.square += (to - from) * 0.5 * (a.force * a.force + b.force * b.force);
    plateau.distance_change += part * (b.knot_distance - a.knot_distance);
  }
  return plateau;
}

/// Least-squares slope of F over s between two extensions, F being straight from sample to sample.
double slope_between(const std::vector<Pull>& pull, double low, double high) {
  const double length = high - low, middle = 0.5 * (low + high);
  double moment = 0.0;  // integral of F (s - middle) ds
  for (std::size_t i = 1; i < pull.size(); ++i) {
    const Pull &a = pull[i - 1], &b = pull[i];
    const double from = std::max(a.extension, low), width = std::min(b.extension, high) - from;
    if (!(width > 0.0)) continue;
    const double slope = (b.force - a.force) / (b.extension - a.extension);
    const double arm = from - middle, force = a.force + slope * (from - a.extension);
    moment += width * (force * (arm + width / 2.0) + slope * width * (arm / 2.0 + width / 3.0));
  }
  return 12.0 * moment / (length * length * length);
}

/// The middle one of the slopes in three parts of equal length. Strands that slip inside a locked knot let the force
/// fall at one place; that is no slope of the rod.
double middle_slope(const std::vector<Pull>& pull, double low, double high) {
  std::array<double, 3> slope;
  for (std::size_t k = 0; k < 3; ++k) {
    const double part = (high - low) / 3.0, from = low + static_cast<double>(k) * part;
    slope[k] = slope_between(pull, from, from + part);
  }
  std::sort(slope.begin(), slope.end());
  return slope[1];
}

std::optional<double> locked_stiffness(const std::vector<Pull>& pull, double from, double peak) {
  std::size_t end = 0;
  while (end < pull.size() && pull[end].force < peak) ++end;
  end = std::min(end + 1, pull.size());
  std::size_t begin = end;
  while (begin > 0 && pull[begin - 1].extension >= from && (pull[begin - 1].force >= 0.5 * peak || end - begin < 3)) {
    --begin;
  }
  if (end < begin + 3) return {};
  return middle_slope(pull, pull[begin].extension, pull[end - 1].extension);
}

/// Of the pull until the knots lock; to its end where they never do [m/s].
double fastest_node_while_sliding(const std::vector<Sample>& samples, std::optional<double> lock_extension) {
  double fastest = 0.0;
  for (const Sample& sample : samples)
    if (sample.phase == Phase::kPull && !(lock_extension && sample.extension > *lock_extension))
      fastest = std::max(fastest, sample.fastest_node);
  return fastest;
}

double stored_energy(const Sample& sample) {
  return sample.stretching_energy + sample.bending_energy + sample.twisting_energy + sample.contact_energy;
}

}  // namespace

EnergyParts energy_between(const Sample& from, const Sample& to) {
  EnergyParts parts;
  parts.work = to.grip_work - from.grip_work;
  parts.stored = stored_energy(to) - stored_energy(from);
  parts.kinetic = to.kinetic_energy - from.kinetic_energy;
  parts.friction = to.friction_loss - from.friction_loss;
  parts.drag = to.dissipation - from.dissipation - parts.friction;
  parts.numerical = to.numerical_dissipation - from.numerical_dissipation;
  parts.reweighting = to.reweighting_loss - from.reweighting_loss;
  return parts;
}

Results analyse(const std::vector<Sample>& samples, EndedBy ended_by) {
  Results results;
  results.ended_by = ended_by;
  if (samples.empty()) return results;

  MotionPatternTracker tracker;
  double imbalance = 0.0;
  double moment_imbalance = 0.0;  // over L [N]
  double energy_error = 0.0;
  double energy_scale = 0.0;
  const Sample& first = samples.front();
  const Sample* before_pull = nullptr;
  const Sample* pull_begin = nullptr;
  const Sample* tied = nullptr;
  for (const Sample& sample : samples) {
    tracker.add(sample);
    results.max_penetration = std::max(results.max_penetration, sample.max_penetration);
    if (sample.status == BenchStatus::kNotEquilibrated) results.not_equilibrated = sample.message;
    const EnergyParts parts = energy_between(first, sample);
    energy_error = std::max(energy_error, std::abs(parts.gap()));
    energy_scale = std::max(
        {energy_scale, std::abs(parts.stored + parts.kinetic), std::abs(parts.losses()), std::abs(parts.work)});
    if (sample.phase == Phase::kTie || sample.phase == Phase::kRelease) tied = &sample;
    if (sample.phase != Phase::kPull) {
      if (!pull_begin) before_pull = &sample;
      continue;
    }
    if (!pull_begin) {
      pull_begin = &sample;
      results.energy = energy_between(before_pull ? *before_pull : sample, samples.back());
    }
    if (sample.status == BenchStatus::kBroken && !results.break_extension) results.break_extension = sample.extension;
    imbalance = std::max(imbalance, std::abs(sample.force_upper - sample.force_lower));
    moment_imbalance = std::max(moment_imbalance, sample.moment_imbalance / sample.end_to_end);
  }
  results.knot_type = samples.back().knot_type;
  results.motion_pattern = tracker.pattern();
  results.motion_pattern_confidence = tracker.confidence();
  results.lock_extension = tracker.lock_extension();
  results.fastest_node = fastest_node_while_sliding(samples, results.lock_extension);
  results.untangled_at = tracker.untangled_at();
  if (energy_scale > 0.0) results.energy_balance_error = energy_error / energy_scale;

  if (!tied) tied = pull_begin;
  if (pull_begin) results.balance_offset = pull_begin->balance_offset;
  const Sample& last = samples.back();
  results.steps = last.steps;
  results.rejected_steps = last.rejected_steps;
  results.newton_iterations = last.newton_iterations;
  results.simulated_time = last.time;
  for (std::size_t k = 0; k < 2; ++k) {
    results.final_excess_length[k] = known(last.excess_length[k]);
    if (tied) results.tied_excess_length[k] = known(tied->excess_length[k]);
  }
  if (tied) results.tied_knot_distance = known(tied->knot_distance);

  const std::vector<Pull>& pull = tracker.pull();
  if (pull.empty()) return results;
  double peak = pull.front().force;
  for (const Pull& p : pull) peak = std::max(peak, p.force);
  results.peak_force = peak;
  if (peak > 0.0) {
    results.force_balance_error = imbalance / peak;
    results.moment_balance_error = moment_imbalance / peak;
  }

  const double start = pull.front().extension;
  if (results.motion_pattern == MotionPattern::kSliding) {
    const double end = results.lock_extension.value_or(pull.back().extension);
    const double low = start + 0.3 * (end - start);
    const Plateau plateau = plateau_between(pull, low, start + 0.8 * (end - start));
    if (plateau.width > 0.0) {
      const double mean = plateau.force / plateau.width;
      results.plateau_force = mean;
      results.plateau_force_sd = std::sqrt(std::max(0.0, plateau.square / plateau.width - mean * mean));
      results.plateau_slope = plateau.distance_change / plateau.width;
    }
    double breakaway = 0.0;
    for (const Pull& p : pull) {
      if (p.extension <= low) breakaway = std::max(breakaway, p.force);
    }
    results.breakaway_force = breakaway;
  }
  // A rod that still slides, or lost its knot, has no stiffness of its own yet.
  const bool carries = results.motion_pattern == MotionPattern::kStretching || results.lock_extension ||
                       results.motion_pattern == MotionPattern::kNone;
  if (carries) {
    results.locked_stiffness = locked_stiffness(pull, results.lock_extension.value_or(start), peak);
  }
  return results;
}

}  // namespace knot_utm
