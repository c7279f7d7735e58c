#include "knot_utm/sim/step_control.hpp"

#include <cmath>
#include <sstream>

namespace knot_utm {
namespace {

constexpr double kGrowth = 1.2;
constexpr double kFastGrowth = 1.6;  // after a step of hardly any work
constexpr int kVeryEasy = 3;
constexpr double kShrink = 0.7;
// Patience and secants come once so many steps have failed in a row, and in steps so short: where tangents fail at
// every other one, the steps would stay short for ever. A step that is abandoned early costs some 5 iterations,
// one by secants up to 8 times the limit of each.
constexpr int kInARow = 6;
constexpr double kShort = 1e-3;  // [longest step]
// A run that so many iterations have led no further than this mean each is not going to end: usual are 0.01 to 1.
constexpr std::uint64_t kPatience = 50'000;
constexpr double kLeastHeadway = 1e-5;  // [longest step]

}  // namespace

StepSummary StepControl::step(TimeStep& stepper, const Boundary& boundary, double dt, bool in_need) {
  StepSummary summary =
      stepper.step(boundary, dt, in_need ? SolveStrategy::kTangents : SolveStrategy::kTangentsAbandonedEarly);
  count(summary);
  if (!summary.accepted() && !summary.newton.converged() && in_need) {
    summary = stepper.step(boundary, dt, SolveStrategy::kSecants);
    count(summary);
  }
  return summary;
}

double StepControl::next_after(double dt, const StepSummary& summary) const {
  double next = next_;
  // Growth starts from what was wanted: the step taken may have been cut to meet an end.
  if (summary.newton.iterations <= options_.easy_iterations)
    next = std::max(next, dt) * (summary.newton.iterations <= kVeryEasy ? kFastGrowth : kGrowth);
  else if (summary.newton.iterations >= options_.hard_iterations && dt >= kShort * options_.longest)
    next = dt * kShrink;  // shorter yet, steps are as hard: two places to be remain two
  // The rod as a whole may move further than its strands against each other: that is no harder to solve.
  if (summary.largest_motion > 0.0) next = std::min(next, dt * options_.motion / summary.largest_motion);
  if (summary.largest_slip > 0.0) next = std::min(next, dt * options_.slip / summary.largest_slip);
  return std::clamp(next, options_.shortest, options_.longest);
}

std::string StepControl::no_headway(double time) {
  const std::uint64_t iterations = counters_.iterations - watched_from_.iterations;
  if (iterations < kPatience) return {};
  const double headway = time - watched_from_.time;
  if (headway < kLeastHeadway * options_.longest * static_cast<double>(iterations)) {
    std::ostringstream reason;
    reason << "the solver makes no headway: the last " << iterations
           << " iterations of Newton's method led only from t = " << watched_from_.time << " s to " << time
           << " s, and the last time step was " << last_tried_ << " s long";
    return reason.str();
  }
  watched_from_ = {time, counters_.iterations};
  return {};
}

std::string StepControl::advance(TimeStep& stepper, double& time, double end, const BoundaryAt& boundary,
                                 const Accepted& accepted) {
  int failed = 0;  // since the last accepted step
  double longest_failed = 0.0;
  halted_ = false;
  while (time < end && !halted_) {
    if (std::string reason = no_headway(time); !reason.empty()) return reason;
    const double remaining = end - time;
    // Steps of equal length up to the end, so that no sliver of a step is left over.
    const double pieces = std::ceil(remaining / std::min(next_, options_.longest) - 1e-9);
    const bool last = pieces <= 1.0;
    const double dt = last ? remaining : remaining / pieces;
    const double to = last ? end : time + dt;
    last_tried_ = dt;

    const bool in_need = failed >= kInARow || dt < kShort * options_.longest;
    const StepSummary summary = step(stepper, boundary(time, to), dt, in_need);
    if (!summary.accepted()) {
      ++counters_.rejected;
      if (failed++ == 0) longest_failed = dt;
      next_ = 0.5 * dt;
      if (next_ < options_.shortest) {
        std::ostringstream reason;
        reason << "the time step fell below " << options_.shortest << " s at t = " << time << " s: " << summary.reason
               << " (residual " << summary.newton.residual << " N, tolerance " << summary.newton.tolerance << " N); "
               << summary.diagnosis.text() << "; " << failed << " steps of " << longest_failed << " to " << dt
               << " s failed, the shorter ones with friction linearised by secants, too";
        return reason.str();
      }
      continue;
    }
    failed = 0;
    ++counters_.steps;
    time = to;
    next_ = next_after(dt, summary);
    accepted(time, dt, summary);
  }
  return {};
}

}  // namespace knot_utm
