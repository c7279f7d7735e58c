#pragma once

#include <string>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/io/run_facts.hpp"

namespace knot_utm {

/// Why the specimen was not at rest when its pull began, as one sentence; empty: it was. At rest tying and release have
/// ended in time, and both grips bear the same force, apart from the rod's weight.
std::string why_not_at_rest(const Results& results, const RunFacts& facts);

}  // namespace knot_utm
