#include "knot_utm/io/run_facts.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>

#include "knot_utm/io/number.hpp"

namespace knot_utm {
namespace {

double stored_energy(const Sample& s) {
  return s.stretching_energy + s.bending_energy + s.twisting_energy + s.contact_energy + s.kinetic_energy;
}

/// Above this a knot has jumped open: its plateau is no longer what its tying made it [m/s].
constexpr double kJump = 0.1;
/// A contact deeper than this is no longer that of the rod it stands for [fraction of radius].
constexpr double kDeep = 0.05;

/// Phases in which both grips carry the specimen.
bool mounted(Phase phase) {
  return phase == Phase::kPreload || phase == Phase::kBalance || phase == Phase::kPull || phase == Phase::kHold;
}

}  // namespace

void RunMonitor::add(const Sample& sample) {
  if (!started_) first_ = sample;
  started_ = true;
  last_ = sample;
  if (sample.phase == Phase::kTie || sample.phase == Phase::kRelease) {
    tied_ = true;
    tied_state_ = sample;
  }
  deepest_ = std::max(deepest_, sample.max_penetration);
  if (sample.phase == Phase::kPull || sample.phase == Phase::kHold) {
    fastest_node_ = std::max(fastest_node_, sample.fastest_node);
  }
  if (mounted(sample.phase)) {
    peak_force_ = std::max(peak_force_, std::abs(sample.force_upper));
    largest_difference_ = std::max(largest_difference_, std::abs(sample.force_upper - sample.force_lower));
  }
  largest_work_ = std::max(largest_work_, std::abs(sample.grip_work - first_.grip_work));
  not_equilibrated_ = not_equilibrated_ || sample.status == BenchStatus::kNotEquilibrated;
}

void RunMonitor::report(RunFacts& facts) const {
  if (!started_) return;
  if (tied_) {
    facts.tied_knot_distance = tied_state_.knot_distance;
    facts.tied_excess_length = {tied_state_.excess_length[0], tied_state_.excess_length[1]};
  }
  facts.not_equilibrated = not_equilibrated_;
  facts.max_penetration = deepest_;
  facts.fastest_node = fastest_node_;
  if (not_equilibrated_) facts.warnings.push_back("tying did not come to rest in time");
  if (fastest_node_ > kJump) {
    facts.warnings.push_back("a node moved at " + format_number(fastest_node_) +
                             " m/s while pulled: a knot may have jumped open; quote the peak force");
  }
  if (deepest_ > kDeep) {
    facts.warnings.push_back("contacts were up to " + format_number(deepest_) + " radii deep");
  }
  if (peak_force_ > 0.0) facts.force_balance_error = largest_difference_ / peak_force_;
  if (largest_work_ > 0.0) {
    const double work = last_.grip_work - first_.grip_work;
    const double lost = last_.dissipation - first_.dissipation;
    const double stored = stored_energy(last_) - stored_energy(first_);
    facts.energy_balance_error = std::abs(work - lost - stored) / largest_work_;
  }
  facts.steps = last_.steps;
  facts.rejected_steps = last_.rejected_steps;
  facts.newton_iterations = last_.newton_iterations;
  facts.simulated_time = last_.time - first_.time;
}

std::uint64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  // Linux counts in KiB.
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024u;
}

std::string version() { return KNOT_UTM_VERSION; }

}  // namespace knot_utm
