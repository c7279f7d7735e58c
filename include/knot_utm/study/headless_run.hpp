#pragma once

#include <functional>
#include <optional>
#include <string>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/io/method.hpp"
#include "knot_utm/io/record.hpp"
#include "knot_utm/machine/program_runner.hpp"

namespace knot_utm {

/// Keeps the records of a run in a further file of its folder, such as a bag.
struct FurtherWriter {
  std::function<void(const Record&)> add;
  std::function<void()> close;  ///< after the last record
};

/// How a test is run without ROS. A function that is empty is not called, except `interrupted`, which must be there.
struct HeadlessOptions {
  std::string folder;              ///< to write to
  bool resume = false;             ///< goes on with the run that was cut off in `folder`
  bool overwrite = false;          ///< writes over what `folder` holds, instead of to the next free one
  std::string begin_with;          ///< the folder of a run that stopped where this one begins; empty: from the start
  std::optional<int> stop_before;  ///< stops before this step of the program, as if it were interrupted there
  bool shapes = false;             ///< also writes shapes.csv, as a run that is resumed does where it began so
  double checkpoint_period = 5.0;  ///< wall time between two checkpoints [s]; 0: none

  /// Makes the further writer of this folder.
  std::function<FurtherWriter(const std::string& folder, const Method& method)> further;
  std::function<bool()> interrupted;                    ///< asked between commands
  std::function<void(const std::string& line)> notice;  ///< warnings, as they come up
  /// Sees each answer of the bench; `wall_time` since the test began [s].
  std::function<void(const Sample& answer, const ProgramRunner& program, double wall_time)> progress;
};

/// How a headless run ended.
struct HeadlessOutcome {
  std::string folder;            ///< that holds what was measured
  std::optional<EndedBy> ended;  ///< none: it was interrupted, and can be resumed
  std::string reason;            ///< of the end, one line
  bool failed = false;           ///< the physics gave up
  std::string failed_step;       ///< the file that holds the time step that failed; empty: there is none
  Results results;               ///< what was measured
  double wall_time = 0.0;        ///< of the whole test, before it was resumed, too [s]
};

/// Throws InvalidInput (key "--resume") where the folder's run cannot be resumed: it has ended or is still running.
/// Changes nothing.
void require_resumable(const std::string& folder);

/// Runs the whole test of a method, or what is left of it, and writes all files of its folder. Where it is interrupted
/// it leaves a checkpoint and its journal. Throws InvalidInput where method and folder do not go together, before
/// anything is written, and std::runtime_error where a file cannot be written; the message says how to recover.
HeadlessOutcome run_headless(const Method& method, const HeadlessOptions& options);

}  // namespace knot_utm
