#pragma once

#include <chrono>

namespace knot_utm {

// How the machine publishes /clock [s of the wall clock].
inline constexpr double kClockPeriod = 0.002;    // shortest time between two messages
inline constexpr double kIdleClockPeriod = 0.1;  // longest time between them
inline constexpr double kGoodbye = 0.3;          // for the last messages to leave before the node ends

/// The wall time that has passed since then [s].
inline double seconds_since(std::chrono::steady_clock::time_point then) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

}  // namespace knot_utm
