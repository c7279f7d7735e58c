#pragma once

#include <vector>

#include "knot_utm/record/sample.hpp"

namespace knot_utm {

struct Results;

/// The state that a phase begins from: the sample before its first, balanced as that one is. A balance in between has
/// left the specimen as it was: s = 0 and F = balance_offset by its definition.
Sample origin_at(const Sample& first, Sample before);

/// Reads the relaxation in the last hold, and the cycles of the last step that cycles, with the elongations of the last
/// of them over the gauge length of `results`. `steps`: as of analyse().
void read_holds_and_cycles(const std::vector<Sample>& samples, const std::vector<int>& steps, Results& results);

}  // namespace knot_utm
