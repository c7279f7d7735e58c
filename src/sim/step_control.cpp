#include "knot_utm/sim/step_control.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace knot_utm {

std::string StepControl::advance(TimeStep& stepper, double& time, double end, const BoundaryAt& boundary,
                                 const Accepted& accepted) {
  while (time < end) {
    const double remaining = end - time;
    // Steps of equal length up to the end, so that no sliver of a step is left over.
    const double pieces = std::ceil(remaining / std::min(next_, options_.longest) - 1e-9);
    const bool last = pieces <= 1.0;
    const double dt = last ? remaining : remaining / pieces;
    const double to = last ? end : time + dt;

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
    double factor = summary.newton.iterations <= options_.easy_iterations   ? 1.2
                    : summary.newton.iterations >= options_.hard_iterations ? 0.7
                                                                            : 1.0;
    if (summary.largest_motion > 0.0) factor = std::min(factor, options_.motion / summary.largest_motion);
    // A piece cut short to meet `end` says nothing against the length it was cut from.
    next_ = std::min(options_.longest, std::max(factor, 0.3) * (factor >= 1.0 ? std::max(dt, last ? next_ : dt) : dt));
    accepted(time, dt, summary);
  }
  return {};
}

}  // namespace knot_utm
