#include "knot_utm/io/claimed_folder.hpp"

#include <optional>
#include <utility>

#include "knot_utm/io/run_folder.hpp"

namespace knot_utm {

ClaimedFolder claim_folder(const std::string& folder, const JournalHeader& header) {
  for (int number = 1;; ++number) {
    const std::string candidate = numbered_folder(folder, number);
    if (holds_run(candidate)) continue;
    std::optional<JournalWriter> journal = JournalWriter::begin_first(candidate, header);
    if (!journal) continue;
    // Another run may have come to its end between the look and the lock.
    if (!holds_results(candidate)) return {candidate, *std::move(journal)};
    journal->remove();
  }
}

std::string free_folder(const std::string& folder) {
  int number = 1;
  while (holds_run(numbered_folder(folder, number))) ++number;
  return numbered_folder(folder, number);
}

std::string moved_notice(const std::string& asked, const std::string& used) {
  return asked + (holds_unfinished_run(asked) ? " holds a run that has not ended" : " holds a run already") +
         ", which stays as it is; this one is written to " + used;
}

}  // namespace knot_utm
