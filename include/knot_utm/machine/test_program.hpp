#pragma once

#include <cstdint>
#include <string>

#include "knot_utm/machine/program.hpp"
#include "knot_utm/machine/sample.hpp"

namespace knot_utm {

/// How a test ended. The names written to result.yaml are those of `ended_by_name`.
enum class EndedBy { kNotYet, kBreak, kExtension, kLoad, kTravel, kOperator, kSolver, kProgram };

const char* ended_by_name(EndedBy end);

/// The test program as a state machine: sees samples, gives commands, knows nothing else.
///
/// Commands come at a fixed period, 1/(k f) with f the cell's sampling rate and k the smallest whole number for
/// which the period is no longer than `longest_period`; every k-th command is a sampling instant of the cell.
class TestProgram {
 public:
  struct Limits {
    double load = 50e3;   ///< ends the test: the cell's capacity [N]
    double travel = 1.0;  ///< ends the test: |displacement| [m]
    double release_timeout = 60.0;
  };
  TestProgram(Program program, double sampling_rate, double longest_period, Limits limits);

  /// The next command after `sample` (the answer to the previous one; none before the first).
  Command first() const;
  Command next(const Sample& sample);

  void stop();     ///< operator
  void balance();  ///< operator: balances at the next command

  bool ended() const { return ended_by_ != EndedBy::kNotYet; }
  EndedBy ended_by() const { return ended_by_; }
  const std::string& reason() const { return reason_; }  ///< one line, when it ended by the solver

  Phase phase() const;
  double period() const;
  double progress() const;  ///< 0..1 share of the programmed time that has passed, estimated

 private:
  Program program_;
  EndedBy ended_by_ = EndedBy::kNotYet;
  std::string reason_;
};

}  // namespace knot_utm
