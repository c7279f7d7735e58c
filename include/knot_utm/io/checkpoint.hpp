#pragma once

#include <cstdint>
#include <string>

#include "knot_utm/machine/program_runner.hpp"
#include "knot_utm/machine/testing_machine.hpp"

namespace knot_utm {

/// A checkpoint: the state of a run between two commands, from which an interrupted run can be continued. It is the
/// file `checkpoint` in the run's folder, which is replaced as a whole, so it is either complete or absent. It holds
/// the state of the simulated machine and of the test program. What was measured before it is in the journal.
class Checkpoint {
 public:
  /// `method`: the text of method.yaml. It must be the same when the checkpoint is loaded.
  Checkpoint(const std::string& folder, const std::string& method);

  /// Writes the state between two commands. `journal_bytes`: length of the journal up to the end of the latest record.
  /// Throws std::runtime_error where the file cannot be written.
  void write(TestingMachine& bench, ProgramRunner& program, std::uint64_t journal_bytes) const;

  bool is_there() const;
  const std::string& file() const { return file_; }

  /// Loads the state into a machine and a program that have just been made from the method. Returns the length of the
  /// journal at the checkpoint [bytes]. Throws InvalidInput, which names the file, where the file is damaged or belongs
  /// to another run.
  std::uint64_t load(TestingMachine& bench, ProgramRunner& program) const;

  void remove() const;

 private:
  void visit(class Archive& archive, TestingMachine& bench, ProgramRunner& program, std::uint64_t& journal_bytes) const;

  std::string file_;
  std::int64_t method_;  // checksum of the method's text
};

}  // namespace knot_utm
