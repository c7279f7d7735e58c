#pragma once

#include <optional>
#include <string>
#include <vector>

namespace knot_utm {

/// The phases of a test. A program is a list of steps, one phase each.
enum class Phase { kIdle, kTie, kRelease, kMount, kPreload, kBalance, kPull, kHold, kDone };

const char* phase_name(Phase phase);  ///< "idle", "tie", "release", ... as in methods and curve files
std::optional<Phase> phase_named(const std::string& name);  ///< the other way; nothing for a name that is none

/// When a step ends: at the first condition that holds.
struct Until {
  std::optional<double> extension;  ///< s reaches it [m]
  std::optional<double> load;       ///< the cell's reading reaches it [N]
  std::optional<double> time;       ///< time since the step began reaches it [s]
  bool broken = false;              ///< `break: true`, the rod broke
};

/// One step of the test program.
struct ProgramStep {
  Phase phase = Phase::kIdle;
  double speed = 0.0033;  ///< pull, preload, mount: crosshead speed [m/s]; tie: speed of the tail grips [m/s]
  double duration = 0.0;  ///< release: ramp and rest [s]; hold: [s]
  double load = 0.0;      ///< preload: the load at which it ends [N]
  Until until;
};

using Program = std::vector<ProgramStep>;

}  // namespace knot_utm
