#pragma once

#include <dirent.h>

#include <cerrno>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "knot_utm/method/method.hpp"
#include "knot_utm/record/ended_by.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {

/// A file that cannot be written: "cannot write FILE: no space left on device", with the reason that errno has.
struct CannotWrite : std::runtime_error {
  explicit CannotWrite(const std::string& file, int error_ = errno)
      : std::runtime_error("cannot write " + file + (error_ == 0 ? "" : ": " + reason_of(error_))), error(error_) {}

  /// Whether the file did not fit. Otherwise the folder was a wrong choice.
  bool out_of_room() const { return error == ENOSPC || error == EDQUOT || error == EFBIG; }

  int error;  ///< errno
};

/// Makes the folder that a command-line argument such as "--report" names. Throws InvalidInput.
void make_folder(const std::string& folder, const char* argument);

/// Throws InvalidInput where the file that a command-line argument names must not be written: it is one of `inputs`,
/// also by a link, or it exists and is not to be overwritten. If `begins` is given, only a file that begins so is
/// overwritten, so that a slip of the hand does not replace a file of another kind.
void require_new_file(const char* argument, const std::string& file, const std::vector<std::string>& inputs,
                      bool overwrite, const std::string& begins = "");

/// The text of a run's method.yaml. It refers to a specimen from a file as specimen.csv, and to a user's knot as
/// knot.yaml: the copies beside it.
std::string method_file_text(const Method& method);

/// Throw InvalidInput (key "--out") where a run would overwrite its own input: the folder holds a record that the
/// method follows, or the method itself as method.yaml that no run wrote.
void require_no_record_in(const std::string& folder, const Method& method);
void require_no_method_in(const std::string& folder, const std::string& method_file);

/// Writes method.yaml and copies of the files that it names, specimen.csv and knot.yaml, and removes the
/// results of an earlier run or comparison. Throws InvalidInput (key "--out") where the folder cannot be written to or
/// holds a record that is followed. Throws std::runtime_error where a copy cannot be written. `options`: those of the
/// command line that decide what the run measures; method.yaml has them as a comment.
void begin_run_folder(const std::string& folder, const Method& method, const std::string& options = "");

/// The options that a run or batch in a folder began with; empty where there are none.
std::string options_of_run(const std::string& folder);

/// The folder of a specimen within that of its batch: FOLDER/specimen_001 for number 1.
std::string specimen_folder(const std::string& folder, int number);
/// All such folders that there are.
std::vector<std::string> specimen_folders(const std::string& folder);

/// Whether the folder contains something that a run there would overwrite or remove: samples, results, a method, a
/// report, a comparison, or the folder of a specimen.
bool holds_run(const std::string& folder);

/// The folder with this number, from 1 on, in the sequence `folder`, `folder-2`, `folder-3` and so on.
std::string numbered_folder(const std::string& folder, int number);

/// The `reason` in result.yaml of a test that was interrupted.
inline constexpr const char* kInterrupted = "interrupted";

/// Whether the folder has the result of a test that ended. A test that was interrupted has not ended.
bool has_complete_result(const std::string& folder);

/// The value of a key in the result.yaml of a folder, as it stands there; empty where there is none.
std::optional<std::string> result_of(const std::string& folder, const std::string& key);

/// The end of a message for a run that cannot write any more: what stands, and how to make results of it; or empty.
std::string what_stands(const std::string& folder);

/// Writes a file so that it appears either completely or not at all. Throws std::runtime_error.
void write_whole(const std::string& file, const std::string& text);

/// Reads a whole file. Throws std::runtime_error, or where the user named it InvalidInput, if it cannot be read.
std::string read_whole(const std::string& file);
std::string read_input(const std::string& file);

/// The folder of a run or a batch, which no other program writes to as long as this object is there. The operating
/// system holds the claim, and lets it go when the process ends, however it does.
class ClaimedFolder {
 public:
  /// Makes the folder where it is not there, and claims it whatever it holds. Throws InvalidInput (key "--out").
  explicit ClaimedFolder(const std::string& folder);

  /// The folder or, where that holds a run already (complete, cut off or under way), the first free one of
  /// numbered_folder. Throws InvalidInput where it cannot be made.
  static ClaimedFolder first_free(const std::string& folder);

  const std::string& path() const { return path_; }

 private:
  ClaimedFolder() : folder_(nullptr, &closedir) {}
  bool claim(const std::string& folder);

  std::string path_;
  std::unique_ptr<DIR, int (*)(DIR*)> folder_;
};

/// The folder that ClaimedFolder::first_free would use now.
std::string free_folder(const std::string& folder);

/// The notice for the user when a run goes to another folder than the one asked for.
std::string moved_notice(const std::string& asked, const std::string& used);

/// Makes the link `out/latest` lead to the folder of a run that stands in a folder called `out`, so that a command that
/// reads `out/latest` reads the run that was written last. Returns its path; empty, and no link, where the run stands
/// elsewhere, something else has that name, or the file system has no links.
std::string point_latest_to(const std::string& folder);

/// A command line that a shell reads back to the same words: those with blanks and the like are quoted.
std::string command_line(int argc, const char* const* argv);
std::string command_line(const std::vector<std::string>& words);

/// How a user calls another program of the package that stands beside the running one: by its path, which is counted
/// from the current folder where it lies below it.
std::string program_beside(const std::string& name);

}  // namespace knot_utm
