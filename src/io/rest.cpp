#include "knot_utm/io/rest.hpp"

#include <algorithm>
#include <cmath>

#include "knot_utm/numeric/number.hpp"

namespace knot_utm {
namespace {

// By choice: the forces of the shipped loops differ by up to 4 % of what they are then, which is 0.05 % of the force
// that is read later on; those of a light rod that a pull shakes by 90 and 1 %.
constexpr double kOfStart = 0.1;      // of the larger force as the pull begins
constexpr double kOfReading = 0.001;  // of the plateau force, or of the largest one where there is no plateau

}  // namespace

std::string why_not_at_rest(const Results& results, const RunFacts& facts) {
  if (!results.not_equilibrated.empty() || !results.at_start) return results.not_equilibrated;
  const GripForces& start = *results.at_start;
  const double larger = std::max(std::abs(start.upper), std::abs(start.lower));
  const double reading = results.true_plateau_force.value_or(results.true_peak_force.value_or(0.0));
  const double most = std::max(kOfStart * larger, kOfReading * std::abs(reading)) + facts.weight;
  if (!(start.difference() > most)) return {};
  return "the specimen was not at rest as its pull began: its grips bore " + short_number(start.upper) + " and " +
         short_number(start.lower) + " N, which would be the same at rest; hold it longer before, or pull more slowly";
}

}  // namespace knot_utm
