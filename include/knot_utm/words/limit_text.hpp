#pragma once

#include <string>

namespace knot_utm {

/// A limit that a message names, with few digits, and still on the allowed side of the true one: `least_text` is no
/// smaller than the smallest value that is allowed, `most_text` no larger than the largest.
std::string least_text(double limit, int digits = 4);
std::string most_text(double limit, int digits = 4);

/// "A to B" of both, with more digits where these would make the ends equal. Only A where nothing lies between them.
std::string limits_text(double least, double most);

}  // namespace knot_utm
