#pragma once

#include <memory>
#include <string>

#include "knot_utm/sim/time_step.hpp"

namespace knot_utm {

/// One time step with all that it depends on: rod, settings, state, boundary and length. It can be tried again
/// elsewhere with the same bits.
struct SavedStep {
  std::unique_ptr<TimeStep> stepper;  ///< as it stood before the step
  Boundary boundary;                  ///< at the end of the step
  double time = 0.0;                  ///< at which it begins [s]
  double dt = 0.0;                    ///< its length [s]

  /// As StepControl does after repeated failures: a step that Newton's method does not solve is tried once more with
  /// secants.
  StepSummary try_again() {
    StepSummary summary = stepper->step(boundary, dt);
    if (!summary.newton.converged()) summary = stepper->step(boundary, dt, SolveStrategy::kSecants);
    return summary;
  }
};

/// The content of a file. Steps that `stepper` has tried since its last accepted step have no effect on it.
std::string save_step(TimeStep& stepper, const Boundary& boundary, double time, double dt);

/// Throws InvalidInput, which names `file`, where the content is not a complete file of a time step.
SavedStep load_step(const std::string& content, const std::string& file);

}  // namespace knot_utm
