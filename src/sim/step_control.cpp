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

}  // namespace

std::string StepControl::advance(TimeStep& stepper, double& time, double end, const BoundaryAt& boundary,
                                 const Accepted& accepted) {
  while (time < end) {
    const double remaining = end - time;
    // Steps of equal length up to the end, so that no sliver of a step is left over.
    const double pieces = std::ceil(remaining / std::min(next_, options_.longest) - 1e-9);
    const bool last = pieces <= 1.0;
    const double dt = last ? remaining : remaining / pieces;
    const double to = last ? end : time + dt;
    last_tried_ = dt;

    const StepSummary summary = stepper.step(boundary(time, to), dt);
    counters_.iterations += static_cast<std::uint64_t>(summary.newton.iterations);
    if (!summary.accepted()) {
      ++counters_.rejected;
      next_ = 0.5 * dt;
      if (next_ < options_.shortest) {
        std::ostringstream reason;
        reason << "time step fell below " << options_.shortest << " s at t = " << time << " s: " << summary.reason
               << " (residual " << summary.newton.residual << " N, tolerance " << summary.newton.tolerance << " N)";
        return reason.str();
      }
      continue;
    }
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
