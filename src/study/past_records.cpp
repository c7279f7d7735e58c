#include "past_records.hpp"

#include "knot_utm/io/run_folder.hpp"
#include "knot_utm/numeric/invalid_input.hpp"

namespace knot_utm {

PastRecords::PastRecords(const std::string& folder, const Method& method, const Checkpoint& checkpoint,
                         TestingMachine& bench, ProgramRunner& program)
    : folder_(folder) {
  JournalReader journal = reader();
  if (!journal.header().same_run(journal_header(method)))
    throw InvalidInput::sentence("method", folder, "the journal belongs to another method than method.yaml beside it")
        .in_file(journal_file(folder));
  bytes_ = journal.good_bytes();
  if (!checkpoint.is_there()) return;
  bytes_ = checkpoint.load(bench, program);
  Record record;
  while (journal.good_bytes() < bytes_ && journal.next(record)) continue;
  if (journal.good_bytes() != bytes_ || journal.records() != program.last().sequence)
    throw InvalidInput::sentence("journal", folder,
                                 "the checkpoint needs " + std::to_string(bytes_) +
                                     " bytes of the journal, of which only " + std::to_string(journal.good_bytes()) +
                                     " are whole")
        .in_file(checkpoint.file());
}

double PastRecords::replay(const std::function<void(const Record&)>& add, JournalWriter& journal) const {
  JournalReader records = reader();
  Record record;
  while (records.good_bytes() < bytes_ && records.next(record)) add(record);
  journal.truncate_to(bytes_);
  return record.wall_time;
}

JournalReader PastRecords::reader() const {
  try {
    return JournalReader(folder_);
  } catch (const InvalidInput& invalid) {
    throw invalid.in_file(journal_file(folder_));
  }
}

}  // namespace knot_utm
