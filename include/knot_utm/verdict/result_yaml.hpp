#pragma once

#include <string>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/verdict/run_facts.hpp"

namespace knot_utm {

/// The text of result.yaml. The keys have a fixed order and SI units, and null stands for a value that does not exist.
/// Among the warnings, those that follow from the results come first.
std::string result_yaml(const Results& results, const RunFacts& facts);

}  // namespace knot_utm
