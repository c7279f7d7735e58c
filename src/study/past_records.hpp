#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "knot_utm/io/checkpoint.hpp"
#include "knot_utm/io/journal.hpp"
#include "knot_utm/io/method.hpp"

namespace knot_utm {

/// The records of a run that is resumed, up to its checkpoint.
class PastRecords {
 public:
  /// Loads the state of machine and program from the checkpoint. Without a checkpoint they stay at the beginning.
  /// Throws InvalidInput where journal, method and checkpoint do not belong together.
  PastRecords(const std::string& folder, const Method& method, const Checkpoint& checkpoint, TestingMachine& bench,
              ProgramRunner& program);

  /// Passes every record to `add` again, and cuts off the journal after the last of them. Returns the wall time that
  /// had passed [s].
  double replay(const std::function<void(const Record&)>& add, JournalWriter& journal) const;

 private:
  JournalReader reader() const;

  std::string folder_;
  std::uint64_t bytes_ = 0;
};

}  // namespace knot_utm
