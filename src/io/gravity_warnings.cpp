#include "knot_utm/io/gravity_warnings.hpp"

#include <cmath>

#include "knot_utm/numeric/number.hpp"

namespace knot_utm {
namespace {

constexpr double kHeavy = 0.01;  // weight over the sliding force, or the largest one

}  // namespace

std::vector<std::string> gravity_warnings(const Results& results, const RunFacts& facts) {
  std::vector<std::string> all;
  if (!(facts.weight > 0.0)) return all;
  const bool slides = results.true_plateau_force.has_value();
  const double force = results.true_plateau_force.value_or(results.true_peak_force.value_or(0.0));
  if (facts.weight > kHeavy * force && force > 0.0)
    all.push_back("the rod weighs " + short_number(facts.weight) + " N, " + short_number(100.0 * facts.weight / force) +
                  " % of the " + (slides ? "sliding" : "largest") +
                  " force: physics.gravity bends strands and tails and may change that force by several times this "
                  "share; a run without it tells");
  return all;
}

}  // namespace knot_utm
