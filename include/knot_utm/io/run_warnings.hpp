#pragma once

#include <string>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/io/run_facts.hpp"

namespace knot_utm {

/// A contact deeper than this is no longer that of the rod it stands for, and deeper than those of any shipped material
/// at its largest load [fraction of radius].
inline constexpr double kDeepContact = 0.05;

/// What befell the specimen while it was pulled, a line each: a knot that jumped open, a roller that was touched.
std::vector<std::string> events(const Results& results);

/// One line where the specimen had not come to rest, or the plateau force may be off by more than a tenth; else empty.
std::string accuracy_warning(const Results& results, const ReadingErrors& errors);

/// All that is said on the console, too, a line each.
std::vector<std::string> told(const Results& results, const RunFacts& facts);

/// All that a reader should know before he believes a reading, a line each: `told` among it.
std::vector<std::string> all_warnings(const Results& results, const RunFacts& facts);

}  // namespace knot_utm
