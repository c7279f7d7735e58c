#pragma once

#include <string>
#include <vector>

namespace knot_utm {

/// A command line that a shell reads back to the same words: those with blanks and the like are quoted.
std::string command_line(int argc, const char* const* argv);
std::string command_line(const std::vector<std::string>& words);

/// How a user calls another program of the package that stands beside the running one, and a script of scripts/: by
/// their paths, which are counted from the current folder where they lie below it.
std::string program_beside(const std::string& name);
std::string script_path(const std::string& name);

}  // namespace knot_utm
