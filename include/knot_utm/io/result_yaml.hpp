#pragma once

#include <string>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/io/run_facts.hpp"

namespace knot_utm {

/// result.yaml: the keys in a fixed order, SI units, null for what is not there; warnings of the results first.
std::string result_yaml(const Results& results, const RunFacts& facts);

/// The keys of result.yaml that are numbers, whether a test has a value of them or not: what a specification may name.
std::vector<std::string> result_numbers();

/// The table of the keys as CSV: key, unit, kind, group, table, meaning. It is report/result_keys.csv.
std::string result_keys_csv();

}  // namespace knot_utm
