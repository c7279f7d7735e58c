#pragma once

#include <string>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/verdict/known_errors.hpp"
#include "knot_utm/verdict/run_facts.hpp"

namespace knot_utm {

/// Overlap beyond which a contact no longer represents the contact of the rod [fraction of radius]. It is larger than
/// the overlaps of every shipped material at its largest load.
inline constexpr double kDeepContact = 0.05;

/// Events of the pull, one line each: a knot that jumped open, a roller that touched a knot.
std::vector<std::string> events(const Results& results);

/// Warnings about the effects of gravity on a specimen, one line each. A loop may slide along the axes of its rollers,
/// where only friction holds it. The weight of strands and tails may change the sliding force, or the largest force
/// where nothing slides.
std::vector<std::string> gravity_warnings(const Results& results, const RunFacts& facts);

/// A warning, one line, where the plateau force may be wrong by more than a tenth. Otherwise empty.
std::string accuracy_warning(const Results& results, const ReadingErrors& errors);

/// The warnings that are also printed on the console, one line each.
std::vector<std::string> printed_warnings(const Results& results, const RunFacts& facts);

/// All warnings that a reader of the results should know, one line each. The printed ones are among them.
std::vector<std::string> all_warnings(const Results& results, const RunFacts& facts);

}  // namespace knot_utm
