#pragma once

#include <string>

#include "knot_utm/verdict/result_keys.hpp"

namespace knot_utm {

// Reasons why a key of result.yaml is null, where the reason depends on the test. The rows of result_keys() refer to
// them. They are evaluated only for keys that have no value.

inline constexpr const char* kNoClass = "the load cell has neither accuracy nor floor";
inline constexpr const char* kFewForDrops = "the load was read fewer than 20 times before the lock";

std::string why_not_pulled(const ResultSource& source);     ///< empty: something was pulled
std::string why_no_whole_pull(const ResultSource& source);  ///< empty: something was pulled, to the end of the pull
std::string why_no_peak(const ResultSource& source);
std::string why_no_plateau(const ResultSource& source);
std::string why_no_plateau_error(const ResultSource& source);
std::string why_no_place_of_drop(const ResultSource& source);
std::string why_no_lock(const ResultSource& source);
std::string why_no_lock_error(const ResultSource& source);
std::string why_no_lock_by_load(const ResultSource& source);
std::string why_no_stiffness(const ResultSource& source);
std::string why_no_stiffness_error(const ResultSource& source);
std::string why_no_peak_error(const ResultSource& source);
std::string why_no_snap(const ResultSource& source);
std::string why_no_efficiency(const ResultSource& source);
std::string why_no_hole(const ResultSource& source);
std::string why_no_break(const ResultSource& source);
std::string why_no_cell_error_in_plateau(const ResultSource& source);

}  // namespace knot_utm
