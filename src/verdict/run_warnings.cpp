#include "knot_utm/verdict/run_warnings.hpp"

#include <cmath>

#include "knot_utm/machine/load_cell.hpp"
#include "knot_utm/numeric/number.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/verdict/known_errors.hpp"
#include "knot_utm/verdict/speed_warnings.hpp"

namespace knot_utm {
namespace {

/// Where energies miss the work by more, what Newton's method leaves unbalanced has a part in the forces too: seen
/// where a loose loop pulls with far less than k_b/h^2, of which `physics.residual` is a fraction.
constexpr double kUnbalanced = 0.01;

constexpr double kForcesDiffer = 0.01;  // of the largest force, as scripts/bench asks for

/// What became of the knot. Where it came undone, the console has a line of its own.
std::vector<std::string> knot_warnings(const Results& results) {
  std::vector<std::string> all;
  if (results.untangled_at && results.knot_type != KnotType::kCrossed && results.ended_by != EndedBy::kUntangled) {
    all.push_back("the knot came undone at " + short_number(*results.untangled_at) +
                  " s, while it was pulled, so there is no sliding force");
  }
  if (results.knot_type == KnotType::kChanged && !results.untangled_at) {
    all.push_back(
        "with its two ends joined, the rod is another knot than at the start; as it still bears the load, nothing came "
        "undone");
  }
  return all;
}

/// Where the simulated rod is not the one that was meant.
std::vector<std::string> physics_warnings(const Results& results) {
  std::vector<std::string> all;
  if (results.knot_type == KnotType::kCrossed) {
    all.push_back("the rod ran through itself at " + short_number(results.untangled_at.value_or(Sample::kNone)) + " s");
  }
  if (results.max_penetration > kDeepContact) {
    all.push_back("strands are pressed into each other by up to " + short_number(results.max_penetration) +
                  " radii, where a contact is right up to " + short_number(kDeepContact));
  }
  if (results.energy_balance_error > kUnbalanced) {
    all.push_back("the energies and the work differ by " + short_number(*results.energy_balance_error) +
                  " of the largest of them: choose a smaller physics.residual");
  }
  return all;
}

/// What the cell cannot tell: forces below its floor, or beyond its stop.
std::vector<std::string> cell_warnings(const Results& results, const LoadCellOptions& cell) {
  std::vector<std::string> all;
  const std::string floor = "the load cell's floor of " + format_number(cell.floor * cell.capacity) + " N";
  if (results.true_peak_force && is_below_floor(cell, *results.true_peak_force)) {
    all.push_back("the peak force lies below " + floor);
  } else if (results.true_plateau_force && is_below_floor(cell, *results.true_plateau_force)) {
    all.push_back("the plateau force lies below " + floor);
  }
  const double stop = cell.overload * cell.capacity;
  if (results.true_peak_force > stop) {
    all.push_back("the load cell was overloaded: above " + format_number(stop) +
                  " N it reads the force at its mechanical stop");
  }
  return all;
}

}  // namespace

std::vector<std::string> events(const Results& results) {
  std::vector<std::string> all;
  const CurveReadings& curve = results.curve;
  if (results.opened_when_mounted)
    all.push_back("a knot opened as the loop was mounted: before the pull the knots had come nearer to each other by " +
                  short_number(*results.opened_when_mounted) + " m");
  if (curve.jump_force)
    all.push_back("a knot jumped open at an extension of " + short_number(*curve.jump_extension) +
                  " m: the load went from " + short_number(*curve.jump_force) + " N to " +
                  short_number(*curve.force_after_jump) + " N, and later readings belong to a looser knot");
  if (results.snap_extension)
    all.push_back("the specimen snapped into another shape at an extension of " +
                  short_number(*results.snap_extension) + " m, where the load fell by " +
                  short_number(*results.snap_drop) + " N at once");
  if (slid_to_the_end(results) && results.true_plateau_force)
    all.push_back(
        "the pull ended while the knots still slid. The plateau force is the mean of what was pulled; a longer pull "
        "may give a larger one");
  if (results.roller_touched_at)
    all.push_back("a roller bore on a knot or its tail from an extension of " +
                  short_number(*results.roller_touched_at) + " m on");
  constexpr double kMuchBalanced = 0.1;
  const double balanced = results.balance_offset.value_or(0.0), plateau = results.true_plateau_force.value_or(0.0);
  if (plateau > 0.0 && std::abs(balanced) > kMuchBalanced * plateau)
    all.push_back("the balance set " + short_number(balanced) + " N to zero, of a sliding force that is in truth " +
                  short_number(plateau) + " N: see true_plateau_force");
  return all;
}

std::vector<std::string> gravity_warnings(const Results& results, const RunFacts& facts) {
  constexpr double kHeavy = 0.01;  // weight over the sliding force, or the largest one
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

std::string accuracy_warning(const Results& results, const ReadingErrors& errors) {
  constexpr double kUnsure = 0.1;
  if (!errors.plateau_force) return {};
  const double share = *errors.plateau_force / std::abs(*results.true_plateau_force);
  if (!(share > kUnsure)) return {};
  return "the plateau force may be off by " + format_number(std::round(100.0 * share)) +
         " %; a finer physics.accuracy, a higher specimen.refinement or several specimens tell more";
}

namespace {

/// What moves while it is pulled, where it moves enough to be felt.
std::string shaken(const Results& results, const RunFacts& facts) {
  if (std::string moved = why_not_at_rest(results, facts); !moved.empty()) return moved;
  if (!results.force_balance_error || !results.true_peak_force) return {};
  if (*results.force_balance_error <= kForcesDiffer + facts.weight / *results.true_peak_force) return {};
  return "the forces on the two grips differ by up to " + short_number(100.0 * *results.force_balance_error) +
         " % of the largest one, where at rest they are the same: pull more slowly";
}

/// Knots that move as they are released are tied at another distance than was asked for.
std::string knots_travelled(const Results& results, const RunFacts& facts) {
  constexpr double kFar = 0.05;  // of the distance, by choice: shipped methods are within 1e-3
  if (!results.tied_knot_distance || !(facts.knot_distance > 0.0)) return {};
  const bool stopped = results.ended_by == EndedBy::kOperator || results.ended_by == EndedBy::kInterrupted;
  if (stopped && !results.true_peak_force) return {};  // perhaps while they were still being tied
  if (std::abs(*results.tied_knot_distance / facts.knot_distance - 1.0) <= kFar) return {};
  return "the knots moved as they were released. They are " + short_number(*results.tied_knot_distance) +
         " m apart instead of " + short_number(facts.knot_distance) + " m (specimen.knot_distance)";
}

/// Warns of a loop that slid along its rollers, which have no friction, or too little.
std::string slid_along_the_rollers(const RunFacts& facts) {
  // By choice, far more than a loop that is held by its rollers' friction moves along them [h].
  constexpr double kSlidAlong = 3.0;
  if (facts.slid_along <= kSlidAlong * facts.material.radius) return {};
  return "the loop slid along the axes of its rollers by " + short_number(facts.slid_along) +
         " m: nothing but machine.roller_friction holds it there";
}

/// Warns of a test that the machine ended too early. A solver that gave up and a knot that came undone say so
/// themselves.
std::string ended_before_pull(const Results& results, const RunFacts& facts) {
  if (results.true_peak_force || results.never_in_tension || results.ended_by != EndedBy::kTravel) return {};
  return "the test ended before anything was pulled: " + facts.reason;
}

/// Warns of an overhand whose pull left it a loose loop. A loop of the radius R under the tension T has 2 T R^2 = k_b
/// without friction, and is wider with it (before_tying.hpp).
std::string stayed_loose(const Results& results, const RunFacts& facts) {
  constexpr double kClosed = 2.0;  // radius of a loop that lies on the strands in it [h]
  const double force = results.true_peak_force.value_or(0.0), h = facts.material.radius;
  const bool whole = results.knot_type == KnotType::kKept && results.break_place == BreakPlace::kNone;
  if (!facts.one_knot_in_a_strand || !whole || !(force > 0.0)) return {};
  const double radius = std::sqrt(facts.material.bending_stiffness / (2.0 * force));
  if (radius <= kClosed * h) return {};
  return "the pull ended while the knot was still loose: the largest force, " + short_number(force) +
         " N, leaves its loop a radius of about " + short_number(radius / h) +
         " radii of the rod, and more with friction; it is tight from about " +
         short_number(facts.material.bending_stiffness / (2.0 * kClosed * kClosed * h * h)) +
         " N on, to which a longer pull brings it";
}

}  // namespace

std::vector<std::string> printed_warnings(const Results& results, const RunFacts& facts) {
  std::vector<std::string> all = physics_warnings(results);
  for (const std::string& event : events(results)) all.push_back(event);
  if (const std::string loose = stayed_loose(results, facts); !loose.empty()) all.push_back(loose);
  for (const std::vector<std::string>& more :
       {gravity_warnings(results, facts), speed_warnings(results.rate, facts.inertia),
        snap_warnings(results, facts.pull_speed), facts.warnings})
    all.insert(all.end(), more.begin(), more.end());
  if (const std::string travelled = knots_travelled(results, facts); !travelled.empty()) all.push_back(travelled);
  if (const std::string slid = slid_along_the_rollers(facts); !slid.empty()) all.push_back(slid);
  if (const std::string early = ended_before_pull(results, facts); !early.empty()) all.push_back(early);
  if (const std::string moved = shaken(results, facts); !moved.empty()) all.push_back(moved);
  const std::string unsure = accuracy_warning(results, known_errors(results, facts));
  if (!unsure.empty()) all.push_back(unsure);
  if (!facts.margin.reason.empty()) all.push_back("no margin: " + facts.margin.reason);
  return all;
}

std::vector<std::string> all_warnings(const Results& r, const RunFacts& f) {
  std::vector<std::string> all = knot_warnings(r);
  for (const std::vector<std::string>& more : {cell_warnings(r, f.load_cell), f.foreseen, printed_warnings(r, f)})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace knot_utm
