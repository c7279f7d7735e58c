#pragma once

#include <cstdint>
#include <limits>

#include "knot_utm/numeric/archive.hpp"

namespace knot_utm {

/// The phases of a test: idle, done, and the steps that a program may have (program/program.hpp). Steps that other code
/// asks for have a name here; further steps have the numbers after kDone.
enum class Phase { kIdle, kTie, kRelease, kMount, kPreload, kBalance, kPull, kHold, kCycle, kReturn, kFollow, kDone };

/// The highest one that a saved state may have. program/phases.hpp has the name of each.
inline constexpr Phase kHighestPhase{63};

/// A command: the motion of the crosshead until `time`. The simulation answers it with a sample of the same time.
struct Command {
  std::uint64_t sequence = 0;  ///< counts commands from 0; the answering sample carries the same number
  double time = 0.0;           ///< [s]
  double displacement = 0.0;   ///< crosshead displacement at `time`, moving linearly since the last command [m]
  double velocity = 0.0;       ///< of the crosshead [m/s]
  double turn = 0.0;           ///< of the upper clamp about the load axis at `time`, turning evenly since then [rad]
  int step = 0;                ///< index of the program's step; -1 before the first
  Phase phase = Phase::kIdle;
  double speed = 0.0;     ///< of the step: tie: speed of the tail grips [m/s]
  double duration = 0.0;  ///< of the step: release [s]
  /// Balanced load at which the crosshead stops, and stands until `time`: moving outwards where the load rises to it,
  /// moving inwards where it falls to it; NaN: none [N]
  double stop_load = std::numeric_limits<double>::quiet_NaN();
  bool balance = false;    ///< zero the load cell and the extension before moving on
  bool read_cell = false;  ///< `time` is a sampling instant of the load cell: `load` is its reading

  void state(Archive& archive);
};

}  // namespace knot_utm
