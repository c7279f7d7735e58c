#pragma once

#include <string>

#include "knot_utm/io/comparison.hpp"

namespace knot_utm {

/// A command line as a shell reads it, for the page that it made.
std::string command_line(int argc, const char* const* argv);

/// Writes report.html and report.pdf into the folder of a run, or of a comparison. They are made by the Python in
/// `report/`, which /usr/bin/python3 runs; `command` is what the page names as the command that made it. Throws
/// std::runtime_error in one line where they cannot be made; nothing else in the folder changes.
void write_report(const std::string& folder, const std::string& command);

/// What a report on a comparison is made of: comparison.yaml, as printed, and the two curves as compared, a.csv and
/// b.csv. Goes to `folder`, or, where another comparison or other curves and pages stand there, to the first of
/// `folder-2`, `folder-3` and so on where none do, unless it may overwrite them; the same files compared again replace
/// what they left. Makes the folder, and returns it. Throws InvalidInput (key "--report") where that cannot be done,
/// where it holds a run, or where one of these files would replace a file that was compared; then nothing is written.
std::string write_comparison(const std::string& folder, const std::string& yaml, const Pull& a, const Pull& b,
                             const std::string& file_a, const std::string& file_b, bool overwrite = false);

}  // namespace knot_utm
