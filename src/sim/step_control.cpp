#include "knot_utm/sim/step_control.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace knot_utm {

namespace {

constexpr double kGrowth = 1.2;
constexpr double kFastGrowth = 1.6;  // after a step of hardly any work
constexpr int kVeryEasy = 3;
constexpr double kShrink = 0.7;
// Secants are tried once so many steps have failed in a row, and in steps that are nearly the shortest.
constexpr int kInARow = 3;
constexpr double kNearlyShortest = 100.0;

}  // namespace

std::string StepControl::advance(TimeStep& stepper, double& time, double end, const BoundaryAt& boundary,
                                 const Accepted& accepted) {
  int failed = 0;  // since the last accepted step
  double longest_failed = 0.0;
  while (time < end) {
    const double remaining = end - time;
    // Steps of equal length up to the end, so that no sliver of a step is left over.
    const double pieces = std::ceil(remaining / std::min(next_, options_.longest) - 1e-9);
    const bool last = pieces <= 1.0;
    const double dt = last ? remaining : remaining / pieces;
    const double to = last ? end : time + dt;
    last_tried_ = dt;

    const Boundary& there = boundary(time, to);
    StepSummary summary = stepper.step(there, dt);
    counters_.iterations += static_cast<std::uint64_t>(summary.newton.iterations);
    const bool in_need = failed >= kInARow || dt < kNearlyShortest * options_.shortest;
    if (!summary.accepted() && !summary.newton.converged() && in_need) {
      summary = stepper.step(there, dt, Solution::kSecants);
      counters_.iterations += static_cast<std::uint64_t>(summary.newton.iterations);
    }
    if (!summary.accepted()) {
      ++counters_.rejected;
      if (failed++ == 0) longest_failed = dt;
      next_ = 0.5 * dt;
      if (next_ < options_.shortest) {
        std::ostringstream reason;
        reason << "time step fell below " << options_.shortest << " s at t = " << time << " s: " << summary.reason
               << " (residual " << summary.newton.residual << " N, tolerance " << summary.newton.tolerance << " N); "
               << summary.diagnosis.text() << "; tried " << failed << " steps from " << longest_failed << " to " << dt
               << " s, the shorter ones with secants of the friction too";
        return reason.str();
      }
      continue;
    }
    failed = 0;
    ++counters_.steps;
    time = to;
    // Growth starts from what was wanted: the step taken may have been cut to meet `end`.
    if (summary.newton.iterations <= options_.easy_iterations)
      next_ = std::max(next_, dt) * (summary.newton.iterations <= kVeryEasy ? kFastGrowth : kGrowth);
    else if (summary.newton.iterations >= options_.hard_iterations)
      next_ = dt * kShrink;
    if (summary.largest_motion > 0.0) next_ = std::min(next_, dt * options_.motion / summary.largest_motion);
    next_ = std::clamp(next_, options_.shortest, options_.longest);
    accepted(time, dt, summary);
  }
  return {};
}

}  // namespace knot_utm
