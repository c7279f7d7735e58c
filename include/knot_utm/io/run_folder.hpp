#pragma once

#include <string>

#include "knot_utm/io/method.hpp"

namespace knot_utm {

/// Makes a folder that an argument of the command line, such as "--report", names. Throws InvalidInput where that
/// cannot be done.
void make_folder(const std::string& folder, const char* argument);

/// Makes the folder of a run. Throws InvalidInput (key "--out") where that cannot be done.
void make_run_folder(const std::string& folder);

/// The text of a run's method.yaml: a specimen from a file is the copy beside it, specimen.csv, and so is a logo,
/// logo.png or logo.svg.
std::string method_file_text(const Method& method);

/// Throws InvalidInput (key "--out") where the folder holds a record that the method follows: the run would write over
/// what it reads.
void require_no_record_in(const std::string& folder, const Method& method);

/// Puts method.yaml and copies of what it names there, specimen.csv and the logo, and takes away the results of an
/// earlier run or comparison. Throws InvalidInput (key "--out") where the folder cannot be written to or holds a record
/// that is followed, std::runtime_error where the copy cannot be written.
void begin_run_folder(const std::string& folder, const Method& method);

/// Whether something stands in the folder that a run there would write over or take away: results, a method, a report,
/// a comparison. `holds_run` counts a journal too, which a run has from its beginning until its results are complete.
bool holds_results(const std::string& folder);
bool holds_run(const std::string& folder);
/// One that goes on, was cut off or interrupted.
bool holds_unfinished_run(const std::string& folder);

/// The `number`th of `folder`, `folder-2`, `folder-3` and so on.
std::string numbered_folder(const std::string& folder, int number);

/// The reason in the result of a test that was interrupted, which its journal lets go on.
inline constexpr const char* kInterrupted = "interrupted";

/// Whether the folder has the result of a test that ran to its end; one that was interrupted has not.
bool has_complete_result(const std::string& folder);
/// Whether it has that of a test that was interrupted.
bool was_interrupted(const std::string& folder);

/// Where the physics gave up: the time step that could not be made (sim/saved_step.hpp), for scripts/replay-step.
std::string failed_step_file(const std::string& folder);

/// A file that is there whole or not at all, so that it can be trusted. Throws std::runtime_error.
void write_whole(const std::string& file, const std::string& text);

/// Throws std::runtime_error where the file cannot be read.
std::string read_whole(const std::string& file);
/// The same of what a user names; throws InvalidInput where it cannot be read.
std::string read_input(const std::string& file);

}  // namespace knot_utm
