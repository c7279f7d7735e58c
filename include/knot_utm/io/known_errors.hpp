#pragma once

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/io/run_facts.hpp"
#include "knot_utm/machine/accuracy.hpp"

namespace knot_utm {

/// Sliding without a lock: where the load rose all the same, the knots were still on their way.
bool slid_to_the_end(const Results& results);

/// How far the readings of this test may be off, as fractions of them: what mesh and tolerances move
/// (`RunFacts::errors`), and of forces and their slopes what drag, inertia and the noise of the load cell add. Of
/// readings whose specimen had not come to rest, or whose knots opened, no study says how far off they are.
ReadingErrors known_errors(const Results& results, const RunFacts& facts);

}  // namespace knot_utm
