#pragma once

#include <knot_utm/Crosshead.h>
#include <knot_utm/KnotRecord.h>
#include <knot_utm/KnotState.h>
#include <knot_utm/SpecimenInfo.h>
#include <knot_utm/TestStatus.h>

#include <string>

namespace knot_utm {

/// What the physics takes from a machine.
struct CrossheadLimits {
  double travel = 1.0;         ///< the crosshead's reach [m]; the last command may pass it by one period's way
  double longest_step = 0.05;  ///< longest time from one command to the next [s]
};

/// What is wrong with a message: "field: value, allowed: what" on one line; empty: nothing. Not-a-number passes only
/// where the message's own description has a meaning for it.
std::string fault_of(const Crosshead& message, const CrossheadLimits& limits);
std::string fault_of(const KnotState& message);
std::string fault_of(const KnotRecord& message);
std::string fault_of(const SpecimenInfo& message);
std::string fault_of(const TestStatus& message);

/// The same of a command as the next one after `last`: time goes on by no more than the longest step, and the crosshead
/// goes no faster than any program may ask for.
std::string fault_after(const Crosshead& last, const Crosshead& message, const CrossheadLimits& limits);

/// The text on one line: control characters as spaces, cut where it is longer than a line of a log should be.
std::string one_line(const std::string& text);

}  // namespace knot_utm
