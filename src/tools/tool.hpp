#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>

#include "command_line_fault.hpp"
#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/verdict/run_facts.hpp"

namespace knot_utm {

/// The exit codes of all tools.
enum ExitCode { kDone = 0, kFailed = 1, kWrongInput = 2 };

/// Prints in one line why a tool ends with this code, and returns the code.
inline int complain(const char* tool, const std::string& why, ExitCode code) {
  std::fprintf(stderr, "%s: %s\n", tool, why.c_str());
  return code;
}

/// Reads the command line, including --version. Returns an exit code where the tool has nothing else to do. `check` may
/// throw a CLI::ParseError, too.
template <class Check>
std::optional<int> parse(CLI::App& app, const char* tool, int argc, char** argv, Check check) {
  app.set_version_flag("--version", version());
  try {
    app.parse(argc, argv);
    if (!missing_value(app).empty()) throw CLI::ArgumentMismatch("a value");
    check();
  } catch (const CLI::ParseError& error) {
    return error.get_exit_code() == 0 ? app.exit(error)
                                      : complain(tool, command_line_fault(app, tool, error), kWrongInput);
  }
  return std::nullopt;
}
inline std::optional<int> parse(CLI::App& app, const char* tool, int argc, char** argv) {
  return parse(app, tool, argc, argv, [] {});
}

/// Runs `body`, and prints one line where it throws. Returns the exit code of `body`, or one of the above.
template <class Body>
int run_tool(const char* tool, Body body) {
  try {
    return body();
  } catch (const InvalidInput& error) {
    return complain(tool, error.what(), kWrongInput);
  } catch (const std::exception& error) {
    return complain(tool, error.what(), kFailed);
  }
}

}  // namespace knot_utm
