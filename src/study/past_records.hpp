#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "knot_utm/io/checkpoint.hpp"
#include "knot_utm/io/journal.hpp"
#include "knot_utm/io/method.hpp"

namespace knot_utm {

/// The records of a run that is resumed, as far as its checkpoint goes.
class PastRecords {
 public:
  /// Loads bench and program as the checkpoint has them; without one they stay at the beginning. Throws InvalidInput
  /// where journal, method and checkpoint do not go together.
  PastRecords(const std::string& folder, const Method& method, const Checkpoint& checkpoint, TestingMachine& bench,
              ProgramRunner& program);

  /// Hands every record to `add` once more and cuts the journal off behind the last; the wall time that had passed [s].
  double replay(const std::function<void(const Record&)>& add, JournalWriter& journal) const;

 private:
  JournalReader reader() const;

  std::string folder_;
  std::uint64_t bytes_ = 0;
};

}  // namespace knot_utm
