#pragma once

#include <string>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/io/run_facts.hpp"

namespace knot_utm {

/// What gravity did to a specimen that it acts on, a line each: along the rollers' axes nothing holds a loop, and the
/// weight of strands and tails has a part in the sliding force, and in any other.
std::vector<std::string> gravity_warnings(const Results& results, const RunFacts& facts);

}  // namespace knot_utm
