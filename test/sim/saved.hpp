#pragma once

#include <string>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/sim/time_step.hpp"

namespace knot_utm {

/// The state of a time step between two steps.
inline std::string saved(TimeStep& stepper) {
  Archive archive("time step");
  archive(stepper);
  return archive.bytes();
}

/// Into a stepper that was made as the saved one was.
inline void load(const std::string& bytes, TimeStep& stepper) {
  Archive archive("time step", bytes, "a file");
  archive(stepper);
  archive.end();
}

}  // namespace knot_utm
