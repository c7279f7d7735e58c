#pragma once

namespace knot_utm {

/// The phases of a test: idle, done, and the steps that a program may have (program/program.hpp). Those that other code
/// asks for have a name here; every other step has the next number behind them.
enum class Phase { kIdle, kTie, kRelease, kMount, kPreload, kBalance, kPull, kHold, kCycle, kReturn, kFollow, kDone };

/// A saved state may have no higher one. Which of them are steps, program/phases.hpp says.
inline constexpr Phase kHighestPhase{63};

}  // namespace knot_utm
