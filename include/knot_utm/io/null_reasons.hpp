#pragma once

#include <string>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/io/run_facts.hpp"

namespace knot_utm {

/// Why a key of result.yaml is null, in a few words; empty where that goes without saying.
std::string why_null(const std::string& key, const Results& results, const RunFacts& facts);

/// Sliding without a lock: where the load rose all the same, the knots were still on their way.
bool slid_to_the_end(const Results& results);

}  // namespace knot_utm
