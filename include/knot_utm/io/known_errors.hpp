#pragma once

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/io/run_facts.hpp"
#include "knot_utm/machine/accuracy.hpp"

namespace knot_utm {

/// Whether the knots slid until the end without locking. A load that rose all the same rose while they were still
/// sliding.
bool slid_to_the_end(const Results& results);

/// Whether knots whose errors were studied slid under so small a force that they were hardly closed.
bool knots_hardly_closed(const Results& results, const RunFacts& facts);

/// Bounds on the errors of the readings of this test, relative to the readings. They consist of the effects of mesh and
/// tolerances (`RunFacts::errors`) and, for forces and their slopes, of those of drag, inertia and the noise of the
/// load cell. That of the peak force follows from the others. They are empty where the specimen had not come to rest,
/// a knot opened or the knots were hardly closed, since no convergence study covers these cases. Those of more
/// than half of the reading are left out.
ReadingErrors known_errors(const Results& results, const RunFacts& facts);

}  // namespace knot_utm
