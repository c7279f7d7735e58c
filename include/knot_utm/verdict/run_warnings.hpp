#pragma once

#include <string>
#include <vector>

#include "knot_utm/verdict/known_errors.hpp"
#include "knot_utm/verdict/trust_limits.hpp"

namespace knot_utm {

/// A warning, one line, where the plateau force may be wrong by more than a tenth. Otherwise empty.
std::string accuracy_warning(const Results& results, const ReadingErrors& errors);

/// The warnings that are also printed on the console, one line each.
std::vector<std::string> printed_warnings(const Results& results, const RunFacts& facts);

/// All warnings that a reader of the results should know, one line each. The printed ones are among them.
std::vector<std::string> all_warnings(const Results& results, const RunFacts& facts);

}  // namespace knot_utm
