#pragma once

#include <optional>
#include <string>
#include <vector>

#include "knot_utm/method/method.hpp"
#include "knot_utm/record/ended_by.hpp"

namespace knot_utm {

/// Makes the folder that a command-line argument such as "--report" names. Throws InvalidInput where that cannot be
/// done.
void make_folder(const std::string& folder, const char* argument);

/// Throws InvalidInput where the file that a command-line argument names must not be written: it is one of `inputs`,
/// also by a link, or it exists and is not to be overwritten. If `begins` is given, only a file that begins so is
/// overwritten, so that a slip of the hand does not replace a file of another kind.
void require_new_file(const char* argument, const std::string& file, const std::vector<std::string>& inputs,
                      bool overwrite, const std::string& begins = "");

/// Makes the folder of a run. Throws InvalidInput (key "--out") where that cannot be done.
void make_run_folder(const std::string& folder);

/// The text of a run's method.yaml. It refers to a specimen from a file as specimen.csv, and to a user's knot as
/// knot.yaml: the copies beside it.
std::string method_file_text(const Method& method);

/// Throws InvalidInput (key "--out") where the folder holds a record that the method follows. The run would overwrite
/// its own input.
void require_no_record_in(const std::string& folder, const Method& method);

/// Throws InvalidInput (key "--out") where the method stands in the folder as method.yaml, and no run wrote it. The run
/// would write over what somebody wrote by hand.
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

/// The folder with this number in the sequence `folder`, `folder-2`, `folder-3` and so on, which begins at 1.
std::string numbered_folder(const std::string& folder, int number);

/// The `reason` in result.yaml of a test that was interrupted.
inline constexpr const char* kInterrupted = "interrupted";

/// Whether the folder has the result of a test that ended. A test that was interrupted has not ended.
bool has_complete_result(const std::string& folder);

/// The value of a key in the result.yaml of a folder, as it stands there; empty where there is none.
std::optional<std::string> result_of(const std::string& folder, const std::string& key);

/// The end of an error message for a run that cannot write any more: what stands, and how to make results of it. Empty
/// where nothing stands.
std::string what_stands(const std::string& folder);

/// Writes a file so that it appears either completely or not at all. Throws std::runtime_error.
void write_whole(const std::string& file, const std::string& text);

/// Reads a whole file. Throws std::runtime_error where it cannot be read.
std::string read_whole(const std::string& file);
/// The same for a file that the user named. Throws InvalidInput where it cannot be read.
std::string read_input(const std::string& file);

}  // namespace knot_utm
