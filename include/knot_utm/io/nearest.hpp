#pragma once

#include <string>
#include <vector>

namespace knot_utm {

/// The known word that takes the fewest single-letter changes to write; the first of equals. Empty: none is known.
std::string nearest(const std::string& word, const std::vector<std::string>& known);

}  // namespace knot_utm
