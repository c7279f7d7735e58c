#pragma once

#include <string>

#include "knot_utm/io/method.hpp"

namespace knot_utm {

/// Makes a folder that an argument of the command line, such as "--report", names. Throws InvalidInput where that
/// cannot be done.
void make_folder(const std::string& folder, const char* argument);

/// Makes the folder of a run. Throws InvalidInput (key "--out") where that cannot be done.
void make_run_folder(const std::string& folder);

/// The text of a run's method.yaml: a specimen from a file is the copy beside it, specimen.csv.
std::string method_file_text(const Method& method);

/// Throws InvalidInput (key "--out") where the folder holds a record that the method follows: the run would write over
/// what it reads.
void require_no_record_in(const std::string& folder, const Method& method);

/// Puts method.yaml and, where the specimen is a file, specimen.csv there, and takes away the results of an earlier
/// run or comparison. Throws InvalidInput (key "--out") where the folder cannot be written to or holds a record that is
/// followed, std::runtime_error where the copy cannot be written.
void begin_run_folder(const std::string& folder, const Method& method);

/// Whether the folder has the result of a test that ran to its end.
bool has_complete_result(const std::string& folder);

/// Where the physics gave up: the time step that could not be made (sim/saved_step.hpp), for scripts/replay-step.
std::string failed_step_file(const std::string& folder);

/// A file that is there whole or not at all, so that it can be trusted. Throws std::runtime_error.
void write_whole(const std::string& file, const std::string& text);

/// Throws std::runtime_error where the file cannot be read.
std::string read_whole(const std::string& file);
/// The same of what a user names; throws InvalidInput where it cannot be read.
std::string read_input(const std::string& file);

}  // namespace knot_utm
