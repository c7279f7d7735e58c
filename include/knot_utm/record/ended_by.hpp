#pragma once

#include <optional>
#include <string>

namespace knot_utm {

/// How a test ended. The names written to result.yaml are those of `ended_by_name`.
enum class EndedBy {
  kNotYet,
  kBreak,        ///< the rod parted, or the load fell as it does in a break
  kExtension,    ///< the last step, a pull or a return, reached its extension
  kLoad,         ///< the last step reached its load, or the load its limit
  kTravel,       ///< the crosshead reached the end of its travel
  kOperator,     ///< stopped
  kSolver,       ///< the simulation gave up, or did not come to rest where it had to
  kProgram,      ///< the last step's time, cycles or record were over
  kTime,         ///< the time limit of the test
  kUntangled,    ///< the knot came undone before it was pulled
  kInterrupted,  ///< a node or the master died, or ROS was shut down
  kPlateau       ///< its plateau was settled, and nothing else was asked for
};

const char* ended_by_name(EndedBy end);  ///< "not yet", "break", "extension", "load", "travel", ...
std::optional<EndedBy> ended_by_named(const std::string& name);  ///< the other way; nothing for a name that is none

/// Whether the specimen is the knot that it began as.
enum class KnotType {
  kKept,
  kChanged,  ///< it came undone, or is another one now
  kCrossed   ///< the rod ran through itself
};

/// Where a rod parted.
enum class BreakPlace {
  kNone,    ///< it is whole
  kStrand,  ///< where it lies free
  kKnot,    ///< where another strand lies against it
  kGrip     ///< on a roller, or where a clamp or node holds it
};

const char* break_place_name(BreakPlace place);  ///< "none", "strand", "knot", "grip"

}  // namespace knot_utm
