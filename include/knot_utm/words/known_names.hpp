#pragma once

#include <string>
#include <vector>

namespace knot_utm {

/// "a, b or c"; other words than " or " may stand before the last one.
std::string listed(const std::vector<std::string>& names, const char* before_last = " or ");

/// The known name that a misspelt one most likely means: the fewest letters added, left out, replaced or swapped, upper
/// and lower case alike. Empty where none is near, or the text is too long to be a name.
std::string nearest_name(const std::string& given, const std::vector<std::string>& known);

}  // namespace knot_utm
