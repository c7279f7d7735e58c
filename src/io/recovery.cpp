#include "knot_utm/io/recovery.hpp"

#include <fcntl.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "knot_utm/io/cannot_write.hpp"
#include "knot_utm/io/command_hint.hpp"
#include "knot_utm/io/run_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

LockedFile lock(const std::string& folder) {
  const std::string file = journal_file(folder);
  LockedFile lock(file, O_RDONLY, 0.0);
  if (lock.is_open()) return lock;
  if (errno == EWOULDBLOCK)
    throw std::runtime_error("a run is still writing " + file + "; there is nothing to recover yet");
  throw InvalidInput::cannot_read(file);
}

}  // namespace

Method journalled_method(const std::string& folder, const JournalHeader& header) {
  const std::string file = (fs::path(folder) / "method.yaml").string();
  Method method = load_method(file);
  if (method.specimens.count > 1)
    throw InvalidInput::sentence("DIR", folder,
                                 shown(folder) +
                                     " holds a batch: recover its specimens one by one, or go on with it by "
                                     "tensile_test --resume");
  if (read_whole(file) != header.method) {
    throw InvalidInput::sentence("file", journal_file(folder),
                                 "the journal belongs to another method than " + shown(file) + " beside it")
        .in_file(journal_file(folder));
  }
  return method;
}

std::string how_to_recover(const std::string& folder) {
  std::error_code error;
  if (!fs::exists(journal_file(folder), error)) return "";
  return "; what was recorded until then is in the journal, write it out with: " +
         command_line({program_beside("recover"), folder, "--out", "ANOTHER_FOLDER"});
}

bool is_settled(const std::string& folder) {
  if (!has_complete_result(folder)) return false;
  const LockedFile journal(journal_file(folder), O_RDONLY, 0.0);
  // A run that is about to begin still has the result of the one before.
  if (!journal.is_open()) return errno != EWOULDBLOCK;
  std::error_code error;
  fs::remove(journal_file(folder), error);
  return true;
}

Recovery::Place::~Place() {
  std::error_code error;
  if (is_scratch) fs::remove_all(folder, error);
}

Recovery::Recovery(const std::string& folder, const std::string& out)
    : folder_(folder),
      out_(out),
      lock_(lock(folder)),
      journal_(folder),
      method_(journalled_method(folder, journal_.header())),
      place_(out) {
  make_place();
  writer_ = std::make_unique<RunWriter>(place(), method_);
}

/// Not over the files that are there, which may be all that a full disk has room for.
void Recovery::make_place() {
  std::error_code error;
  if (fs::equivalent(folder_, out_, error)) {
    place_.folder = (fs::path(folder_) / "recovering").string();
    place_.is_scratch = true;
    fs::remove_all(place_.folder, error);
  } else if (holds_run(out_)) {
    throw InvalidInput::sentence("--out", out_,
                                 "the folder " + shown(out_) + " holds a run already: choose another folder");
  }
}

bool Recovery::next(Record& record) {
  if (!journal_.next(record)) return false;
  writer_->add(record);
  if (record.shape.cols() > 0) shape_ = record.shape;
  wall_time_ = record.wall_time;
  next_ = record.command.sequence + 1;
  return true;
}

void Recovery::finish() {
  RunFacts facts = writer_->facts();
  facts.reason = journal_.header().test.empty() ? "the program was killed" : "the recorder died";
  facts.wall_time = wall_time_;
  facts.peak_memory = 0;
  facts.warnings.push_back("these results were rebuilt from the journal and end where the recording ended");
  const std::uint64_t dropped = next_ - journal_.records();
  if (dropped > 0) facts.warnings.push_back(std::to_string(dropped) + " commands of the test were not recorded");
  // No journal has it: a recorder writes it as it comes.
  const std::string step = failed_step_file(folder_);
  if (!place_.is_scratch && fs::exists(step)) write_whole(failed_step_file(out_), read_whole(step));
  writer_->finish(writer_->results(EndedBy::kNotYet), facts, shape_);
  if (place_.is_scratch) move_into_place();
}

/// The result last: where it is, all is.
void Recovery::move_into_place() const {
  for (const char* name : {"curve.csv", "curve_full.csv", "test.bag", "shapes.csv", "final_shape.csv", "result.yaml"}) {
    const fs::path made = fs::path(place_.folder) / name;
    std::error_code error;
    if (!fs::exists(made, error)) continue;
    const fs::path there = fs::path(out_) / name;
    fs::rename(made, there, error);
    if (error) throw CannotWrite(there.string(), error.value());
  }
}

std::string Recovery::summary() const {
  std::string line = std::to_string(journal_.records()) + " commands of the test were written to " + out_;
  const std::uint64_t left = journal_.bytes_left();
  if (left > 0)
    line += "; the last " + std::to_string(left) + " bytes of the journal were cut off or damaged and are left out";
  return line;
}

}  // namespace knot_utm
