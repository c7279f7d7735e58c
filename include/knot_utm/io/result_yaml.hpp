#pragma once

#include <string>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/io/run_facts.hpp"

namespace knot_utm {

/// The text of result.yaml. The keys have a fixed order and SI units, and null stands for a value that does not exist.
/// Among the warnings, those that follow from the results come first.
std::string result_yaml(const Results& results, const RunFacts& facts);

/// The keys of result.yaml that are numbers, whether or not a test has a value of them. A specification may name these
/// keys.
std::vector<std::string> result_numbers();

/// The table of the keys as CSV with the columns key, unit, kind, group, table and meaning: what
/// `tensile_test --list-results` prints.
std::string result_keys_csv();

}  // namespace knot_utm
