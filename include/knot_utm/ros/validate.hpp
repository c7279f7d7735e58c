#pragma once

#include <knot_utm/Crosshead.h>
#include <knot_utm/KnotRecord.h>
#include <knot_utm/KnotState.h>
#include <knot_utm/SpecimenInfo.h>
#include <knot_utm/TestStatus.h>

#include <string>

namespace knot_utm {

/// Limits of the commands that the simulation accepts.
struct CrossheadLimits {
  double travel = 1.0;  ///< travel of the crosshead [m]; the last command may exceed it by the motion in one period
  double longest_step = 0.05;  ///< longest time from one command to the next [s]
};

/// The fault of a message in one line: "FIELD is VALUE, but must be ALLOWED". Empty: there is none. NaN is accepted
/// only where the description of the message gives it a meaning.
std::string fault_of(const Crosshead& message, const CrossheadLimits& limits);
std::string fault_of(const KnotState& message);
std::string fault_of(const KnotRecord& message);
std::string fault_of(const SpecimenInfo& message);
std::string fault_of(const TestStatus& message);

/// The same for a command that follows `last`: the time advances by at most the longest step, and the crosshead is no
/// faster than any program may ask for.
std::string fault_after(const Crosshead& last, const Crosshead& message, const CrossheadLimits& limits);

/// The text on one line: control characters become spaces, and a text too long for a line of a log is cut.
std::string one_line(const std::string& text);

}  // namespace knot_utm
