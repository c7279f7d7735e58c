#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/verdict/run_facts.hpp"

namespace knot_utm {

/// Runs a module of the Python package knot_utm, "knot_utm.report", with these words, and returns its exit code, 1
/// where it cannot be run. `said`: a file to which all goes that it prints; empty: the program's own output.
inline int run_python(const std::string& module, const std::vector<std::string>& with, const std::string& said = "") {
  std::error_code error;
  const std::filesystem::path here = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  std::filesystem::path packages = here.parent_path() / "python3" / "dist-packages";  // of an installation
  if (!std::filesystem::is_directory(packages / "knot_utm" / "report", error)) packages = KNOT_UTM_PYTHON_DIR;
  // By -s and -P, and with no other PYTHONPATH, Debian's Python finds Debian's packages, and none of the user's own.
  std::vector<std::string> words{"/usr/bin/env", "-u", "PYTHONHOME", "PYTHONPATH=" + packages.string()};
  words.insert(words.end(),
               {"KNOT_UTM_TOOLS_DIR=" + here.string(), "/usr/bin/python3", "-sPB", "-W", "ignore", "-m", module});
  words.insert(words.end(), with.begin(), with.end());
  const std::string to = said.empty() ? "" : " >> " + command_line({said}) + " 2>&1";
  const int status = std::system((command_line(words) + to).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

/// Has the Python package knot_utm write report.html and report.pdf into the folder of a run or of a comparison.
/// `command` is what the page names as its origin. Returns whether both are written; where they are not, Python has
/// said why in one line. Nothing else in the folder changes.
inline bool make_report(const std::string& folder, const std::string& command) {
  return run_python("knot_utm.report", {"--command", command, "--version", version(), "--", folder}) == 0;
}

}  // namespace knot_utm
