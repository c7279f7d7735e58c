#pragma once

#include <cstdint>
#include <string>

#include "knot_utm/machine/program_runner.hpp"
#include "knot_utm/machine/testing_machine.hpp"

namespace knot_utm {

/// A checkpoint: the state of a run between two commands, from which other runs can begin. It is the file `checkpoint`
/// in the run's folder, which is replaced as a whole, so it is either complete or absent. It holds the state of the
/// simulated machine and of the test program. What was measured before it is in samples.csv.
class Checkpoint {
 public:
  /// `method`: the text of method.yaml. It must be the same when the checkpoint is loaded.
  Checkpoint(const std::string& folder, const std::string& method);

  /// Throws std::runtime_error where the file cannot be written.
  void write(TestingMachine& bench, ProgramRunner& program) const;

  bool is_there() const;
  const std::string& file() const { return file_; }

  /// Loads the state into a machine and a program that have just been made from the method. Throws InvalidInput, which
  /// names the file, where the file is damaged or belongs to another run.
  void load(TestingMachine& bench, ProgramRunner& program) const;

 private:
  void visit(class Archive& archive, TestingMachine& bench, ProgramRunner& program) const;

  std::string file_;
  std::int64_t method_;  // checksum of the method's text
};

}  // namespace knot_utm
