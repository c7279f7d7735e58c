#pragma once

#include <functional>
#include <utility>

#include "knot_utm/machine/program_runner.hpp"
#include "knot_utm/run/record.hpp"

namespace knot_utm {

/// What was measured by another run, in whose state after that a test begins. The test has the same bytes as one from
/// the start, since its program has asked for all that was measured, and the state of the simulated machine is whole.
class Beginning {
 public:
  using Visitor = std::function<void(const Record&)>;

  /// `each`: hands all records of that run to its visitor, in their order, as often as it is called.
  explicit Beginning(std::function<void(const Visitor&)> each) : each_(std::move(each)) {}

  /// The program, which has just been made, sees all answers without any physics. Whether it asks for them; a program
  /// that does not is then unusable.
  bool follow(ProgramRunner& program) const;

  /// Shows every record. Returns the wall time of the other run up to there [s]. The wall time of the new run begins
  /// with it, so that it is that of the whole test wherever the beginning comes from.
  double replay(const Visitor& visit) const;

 private:
  std::function<void(const Visitor&)> each_;
};

}  // namespace knot_utm
