#pragma once

#include <string>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/io/run_facts.hpp"

namespace knot_utm {

/// Warnings about the effects of gravity on a specimen, one line each. A loop may slide along the axes of its rollers,
/// where only friction holds it. The weight of strands and tails may change the sliding force, or the largest force
/// where nothing slides.
std::vector<std::string> gravity_warnings(const Results& results, const RunFacts& facts);

}  // namespace knot_utm
