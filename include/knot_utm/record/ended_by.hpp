#pragma once

#include <cstddef>
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

/// In the order of the enumeration.
inline constexpr const char* kEndNames[] = {"not yet", "break",   "extension", "load",      "travel",      "operator",
                                            "solver",  "program", "time",      "untangled", "interrupted", "plateau"};

inline const char* ended_by_name(EndedBy end) { return kEndNames[static_cast<std::size_t>(end)]; }

/// The other way; nothing for a name that is none.
inline std::optional<EndedBy> ended_by_named(const std::string& name) {
  for (int i = 0; i <= static_cast<int>(EndedBy::kPlateau); ++i)
    if (name == ended_by_name(static_cast<EndedBy>(i))) return static_cast<EndedBy>(i);
  return std::nullopt;
}

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

/// In the order of the enumeration.
inline constexpr const char* kBreakPlaceNames[] = {"none", "strand", "knot", "grip"};

inline const char* break_place_name(BreakPlace place) { return kBreakPlaceNames[static_cast<std::size_t>(place)]; }

}  // namespace knot_utm
