#pragma once

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "knot_utm/verdict/run_facts.hpp"

namespace knot_utm {

/// The command that runs a module of the Python package knot_utm. More words may follow.
inline std::vector<std::string> python_module(const std::string& module) {
  std::error_code error;
  const std::filesystem::path here = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  std::filesystem::path packages = here.parent_path() / "python3" / "dist-packages";  // of an installation
  if (!std::filesystem::is_directory(packages / "knot_utm" / "report", error)) packages = KNOT_UTM_PYTHON_DIR;
  // By -s and -P, and with no other PYTHONPATH, Debian's Python finds Debian's packages, and none of the user's own.
  std::vector<std::string> words{"/usr/bin/env", "-u", "PYTHONHOME", "PYTHONPATH=" + packages.string()};
  words.insert(words.end(), {"KNOT_UTM_TOOLS_DIR=" + here.string(), "/usr/bin/python3", "-sPB", "-W", "ignore", "-m",
                             "knot_utm." + module});
  return words;
}

/// Has it write report.html and report.pdf into the folder of a run or of a comparison. `command` is what the page
/// names as its origin. Returns whether both are written; where they are not, Python has said why in one line. Nothing
/// else in the folder changes.
inline bool make_report(const std::string& folder, const std::string& command) {
  std::vector<std::string> words = python_module("report");
  words.insert(words.end(), {"--command", command, "--version", version(), "--", folder});
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  int status = 0;
  if (posix_spawn(&child, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0) return false;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace knot_utm
