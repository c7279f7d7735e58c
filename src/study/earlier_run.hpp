#pragma once

#include <cstdint>
#include <string>

#include "knot_utm/machine/program_runner.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/run/samples.hpp"

namespace knot_utm {

/// A run that stopped before a step of its program, and from whose state runs of other methods begin. These must have
/// the same specimen, material, machine and physics, and their programs must give the same commands up to that step. A
/// run that begins here therefore has the same bytes as one from the beginning.
class EarlierRun {
 public:
  /// Brings machine and program, which have just been made from `method`, to the state in which the run in `folder`
  /// stopped. Throws InvalidInput (key "--begin-with") where there is no such run, where it does not suit the method,
  /// or where the new run would write over it in `out`.
  EarlierRun(const std::string& folder, const std::string& out, const Method& method, TestingMachine& bench,
             ProgramRunner& program);

  /// Appends every record to the samples of the new run. Returns the wall time of the earlier run [s].
  double replay(SamplesWriter& samples) const;

 private:
  void check_method(const Method& method) const;
  void follow(ProgramRunner& program, std::uint64_t records) const;

  std::string folder_;
  Method method_;
};

}  // namespace knot_utm
