#pragma once

#include <string>

#include "knot_utm/analysis/comparison.hpp"

namespace knot_utm {

/// A reading for a person: with the prefix of its unit that suits its size, and as many digits as its error leaves,
/// else four. "4.98 ± 0.24 N", "345.2 kN/m". `unit` is that of result.yaml.
std::string reading_text(double value, const std::string& unit, double error = 0.0);

/// The main readings of a run or a batch on at most ten lines, from the result.yaml or statistics.yaml in its folder,
/// which have all of them. Throws InvalidInput where the folder has neither, or the file cannot be read.
std::string run_summary(const std::string& folder);

/// The same of a comparison: each reading that one of the curves has, of A, of B, and their difference.
std::string comparison_summary(const Comparison& comparison, const std::string& file_a, const std::string& file_b);

}  // namespace knot_utm
