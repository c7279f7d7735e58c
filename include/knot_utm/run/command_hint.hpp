#pragma once

#include <string>
#include <vector>

namespace knot_utm {

/// A command line that a shell reads back to the same words: those with blanks and the like are quoted.
std::string command_line(int argc, const char* const* argv);
std::string command_line(const std::vector<std::string>& words);

/// How a user calls another program of the package that stands beside the running one: by its path, which is counted
/// from the current folder where it lies below it.
std::string program_beside(const std::string& name);

}  // namespace knot_utm
