#pragma once

#include <optional>
#include <string>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/verdict/run_facts.hpp"

namespace knot_utm {

/// Why the specimen was not at rest when its pull began, as one sentence; empty: it was. Then tying and release had
/// ended in time, and both grips bore the same force, apart from the rod's weight.
std::string why_not_at_rest(const Results& results, const RunFacts& facts);

/// Whether the knots slid until the end without locking. A rising load alone is no lock: it may rise while they slide.
bool slid_to_the_end(const Results& results);

/// By how many weights of the rod the forces on two grips may differ at rest. What holds the middle of a loop's far
/// side makes that side as uneven as the one with the knots, which has most of the weight.
inline constexpr double kDifferByWeight = 2.0;

/// Whether knots whose errors were studied slid under so small a force that they were hardly closed.
bool knots_hardly_closed(const Results& results, const RunFacts& facts);

/// Bounds on the errors of the readings of a test, each in the unit of its reading.
struct ReadingErrors {
  std::optional<double> plateau_force;     ///< [N]
  std::optional<double> lock_extension;    ///< [m]
  std::optional<double> locked_stiffness;  ///< [N/m]
  std::optional<double> peak_force;        ///< follows from the others [N]
};

/// The errors consist of the effects of mesh and tolerances (`RunFacts::errors`) and, for forces and their slopes, of
/// those of drag, inertia and the noise of the load cell. They are empty where no convergence study covers the case:
/// the specimen had not come to rest, a knot opened, or knots that do not roll were hardly closed (else
/// errors_of_hardly_closed). Those of more than half of the reading are left out.
ReadingErrors known_errors(const Results& results, const RunFacts& facts);

}  // namespace knot_utm
