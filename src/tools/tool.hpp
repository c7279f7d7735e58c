#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/verdict/run_facts.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {

/// The exit codes of all tools.
enum ExitCode { kDone = 0, kFailed = 1, kWrongInput = 2 };

/// Prints in one line why a tool ends with this code, and returns the code.
inline int complain(const char* tool, const std::string& why, ExitCode code) {
  std::fprintf(stderr, "%s: %s\n", tool, why.c_str());
  return code;
}

/// The program as it was called, for a command that can be pasted.
inline std::string program_called(const CLI::App& app) { return command_line({app.get_name()}); }

/// The end of a message for an unknown option: "; did you mean --out?", or a reference to --help.
inline std::string hint_at_option(const CLI::App& app, const std::string& given) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  const std::string nearest = nearest_name(given, names);
  return nearest.empty() ? "; see " + program_called(app) + " --help" : "; did you mean " + nearest + "?";
}

/// A sentence for an option whose value is missing, because the name of another option follows it. Empty where there is
/// none.
inline std::string missing_value(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options())
    for (const std::string& value : option->results())
      if (value.rfind("--", 0) == 0 && app.get_option_no_throw(value) != nullptr)
        return option->get_name() + " needs a value, but the option " + value + " follows it";
  return {};
}

/// A sentence that says what is wrong with a command line and names the argument. The messages of CLI11 speak of types
/// and limits of the program instead.
inline std::string command_line_fault(const CLI::App& app, const std::string& tool, const CLI::ParseError& error) {
  std::string missing = missing_value(app);
  if (!missing.empty()) return missing;
  const std::vector<std::string> unknown = app.remaining();
  if (!unknown.empty() && unknown.front().rfind('-', 0) == 0) {
    const std::string given = shown(unknown.front().substr(0, unknown.front().find('=')));
    return given + " is no option of " + tool + hint_at_option(app, given);
  }
  if (!unknown.empty())
    return "\"" + shown(unknown.front()) + "\" is one argument too many; see " + program_called(app) + " --help";
  constexpr std::size_t kNone = std::string::npos;
  std::string said = shown(error.what());
  const std::string number = "Could not convert: ";  // --jobs = abc
  if (said.rfind(number, 0) == 0) said = said.substr(number.size());
  const std::string name = said.substr(0, said.find_first_of(": "));
  const CLI::Option* option = app.get_option_no_throw(name);
  const std::string description = option == nullptr ? "" : option->get_description();
  if (error.get_name() == "RequiredError") return name + " is missing: give " + description;
  if (error.get_name() == "ArgumentMismatch") return name + " needs a value: " + description;
  if (error.get_name() == "ExcludesError")
    return name + " and " + said.substr(said.rfind(' ') + 1) + " cannot be given together";
  if (option == nullptr || option->results().empty()) return said;
  std::string given = name + " is " + shown(option->results().back()) + ", but must be a number";
  if (error.get_name() == "ConversionError") return given;
  return said.find(" not in range 0") == kNone ? said : given + " of at least 0";
}

/// Reads the command line, including --version. Returns an exit code where the tool has nothing else to do. `check` may
/// throw a CLI::ParseError, too.
template <class Check = void (*)()>
std::optional<int> parse(
    CLI::App& app, const char* tool, int argc, char** argv, Check check = [] {}) {
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
