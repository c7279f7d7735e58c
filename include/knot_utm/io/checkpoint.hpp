#pragma once

#include <cstdint>
#include <string>

#include "knot_utm/machine/program_runner.hpp"
#include "knot_utm/machine/testing_machine.hpp"

namespace knot_utm {

/// A moment at which a run can be taken up again: `checkpoint` in its folder, there whole or not at all. All that came
/// before is in the journal; bench and program are what goes on.
class Checkpoint {
 public:
  /// `method`: the text of method.yaml, which must be the same when it is loaded.
  Checkpoint(const std::string& folder, const std::string& method);

  /// Between two commands; `journal_bytes` is the end of the latest record. Throws std::runtime_error.
  void write(TestingMachine& bench, ProgramRunner& program, std::uint64_t journal_bytes) const;

  bool is_there() const;
  const std::string& file() const { return file_; }

  /// Into a bench and a program just made from the method; returns the journal's bytes. Throws InvalidInput, which
  /// names the file, where it is damaged or that of another run.
  std::uint64_t load(TestingMachine& bench, ProgramRunner& program) const;

  void remove() const;

 private:
  void visit(class Archive& archive, TestingMachine& bench, ProgramRunner& program, std::uint64_t& journal_bytes) const;

  std::string file_;
  std::int64_t method_;  // checksum of its text
};

}  // namespace knot_utm
