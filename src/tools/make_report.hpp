#pragma once

#include <string>

#include "knot_utm/verdict/run_facts.hpp"
#include "run_python.hpp"

namespace knot_utm {

/// Has the Python package knot_utm write report.html and report.pdf into the folder of a run or of a comparison.
/// `command` is what the page names as its origin. Returns whether both are written; where they are not, Python has
/// said why in one line. Nothing else in the folder changes.
inline bool make_report(const std::string& folder, const std::string& command) {
  return run_python("knot_utm.report", {"--command", command, "--version", version(), "--", folder}) == 0;
}

}  // namespace knot_utm
