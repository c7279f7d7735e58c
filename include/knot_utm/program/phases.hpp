#pragma once

#include <optional>
#include <string>
#include <vector>

#include "knot_utm/record/command.hpp"

namespace knot_utm {

const char* phase_name(Phase phase);                        ///< in methods, messages and curve files
std::optional<Phase> phase_named(const std::string& name);  ///< empty where no phase has this name
Phase last_phase();                                         ///< the one with the largest number
std::vector<Phase> all_phases();                            ///< in the order of their numbers

/// What the rest of the package needs to know of a phase; a step names its own (Step::Trait). The report reads them
/// from `tensile_test --list-phases`.
bool prepares(Phase phase);
bool forms(Phase phase);
bool ends_by_itself(Phase phase);
bool rests(Phase phase);
bool moves(Phase phase);
bool loads(Phase phase);
bool pulls(Phase phase);
bool can_break(Phase phase);

}  // namespace knot_utm
