#pragma once

#include <optional>
#include <string>
#include <vector>

namespace knot_utm {

/// The phases of a test. A program is a list of steps, one phase each.
enum class Phase { kIdle, kTie, kRelease, kMount, kPreload, kBalance, kPull, kHold, kCycle, kReturn, kFollow, kDone };

/// What the rest of the package needs to know of a phase. The table of them stands in phase.cpp; the report reads
/// it from `tensile_test --list-phases`.
struct PhaseTraits {
  Phase phase;
  const char* name;     ///< in methods, messages and curve files
  bool is_step;         ///< a program may have it as a step
  bool prepares;        ///< the specimen is made, mounted and zeroed, before the test proper
  bool forms;           ///< the specimen is being tied, or let go once it is tied
  bool ends_by_itself;  ///< the machine says when it is done; other steps end at a condition of the program
  bool moves;           ///< the crosshead moves
  bool pulls;           ///< the specimen may be pulled further than before: these samples make the curve
  bool can_break;       ///< a falling load in it is judged as a break
};

const PhaseTraits& traits_of(Phase phase);

inline const char* phase_name(Phase phase) { return traits_of(phase).name; }
inline bool forms(Phase phase) { return traits_of(phase).forms; }
inline bool moves(Phase phase) { return traits_of(phase).moves; }
inline bool pulls(Phase phase) { return traits_of(phase).pulls; }

std::optional<Phase> phase_named(const std::string& name);  ///< empty where no phase has this name

std::vector<PhaseTraits> all_phases();  ///< in the order of the enumeration
std::vector<std::string> step_names();  ///< of the phases that are steps

}  // namespace knot_utm
