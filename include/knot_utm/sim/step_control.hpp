#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>

#include "knot_utm/sim/time_step.hpp"

namespace knot_utm {

/// Step-size control: time steps become longer where Newton's method converges in few iterations, nodes move little and
/// strands slip little against each other, and shorter otherwise. A step that was not accepted is tried again with half
/// its length. After some failures in a row Newton's method is no longer abandoned early, and is tried once more with
/// secants before the step is halved again (SolveStrategy). A run that hardly advances over very many iterations is
/// given up. Source: Hairer, Wanner 1996 (step-size control).
class StepControl {
 public:
  struct Options {
    double longest = 0.1;                                   ///< [s]
    double first = 0.1;                                     ///< what is tried first [s]
    double shortest = 1e-7;                                 ///< below it the run gives up [s]
    double motion = 0.0;                                    ///< motion of the fastest node that a step aims at [m]
    double slip = std::numeric_limits<double>::infinity();  ///< slip of strands in contact that a step aims at [m]
    int easy_iterations = 6;                                ///< up to here the next step may be longer
    int hard_iterations = 10;                               ///< from here on it is shorter
  };
  struct Counters {
    std::uint64_t steps = 0, rejected = 0, iterations = 0, by_half = 0;
  };

  explicit StepControl(const Options& options) : options_(options), next_(options.first) {}

  /// Boundary at the end of a step from time `from` to time `to` [s].
  using BoundaryAt = std::function<const Boundary&(double from, double to)>;
  /// Called after every accepted step.
  using Accepted = std::function<void(double time, double dt, const StepSummary&)>;

  /// Steps from `time` to exactly `end` [s]. Returns an empty string, or why it gave up; `time` is then the time
  /// reached.
  std::string advance(TimeStep& stepper, double& time, double end, const BoundaryAt& boundary,
                      const Accepted& accepted);

  /// For `accepted`: the next step is no longer than this [s].
  void at_most(double dt) { next_ = std::min(next_, std::max(dt, options_.shortest)); }
  /// For `accepted`: `advance` ends with this step, as if it had come to its end.
  void halt() { halted_ = true; }

  const Counters& counters() const { return counters_; }

  void state(Archive& archive) {
    archive(next_, counters_.steps, counters_.rejected, counters_.iterations, counters_.by_half, watched_from_.time,
            watched_from_.iterations);
  }

 private:
  StepSummary step(TimeStep& stepper, const Boundary& boundary, double dt, bool in_need);
  void count(const StepSummary& summary) {
    counters_.iterations += static_cast<std::uint64_t>(summary.newton.iterations);
    counters_.by_half += static_cast<std::uint64_t>(summary.by_half);
  }
  double next_after(double dt, const StepSummary& summary) const;
  std::string no_headway(double time);

  Options options_;
  double next_, last_tried_ = 0.0;
  Counters counters_;
  bool halted_ = false;
  struct {
    double time = 0.0;
    std::uint64_t iterations = 0;
  } watched_from_;  ///< since when progress is measured
};

}  // namespace knot_utm
