#include "knot_utm/verdict/known_errors.hpp"

#include <algorithm>
#include <cmath>

#include "knot_utm/breaking/breaking_laws.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

// By choice: the forces of the shipped loops differ by up to 4 % of what they are then, which is 0.05 % of the force
// that is read later on; those of a light rod that a pull shakes by 90 and 1 %.
constexpr double kOfStart = 0.1;      // of the larger force as the pull begins
constexpr double kOfReading = 0.001;  // of the plateau force, or of the largest one where there is no plateau

constexpr double kMeaningless = 0.5;  // an error that is more than this of the reading says nothing

/// By how much a stiffness changes where the part that it is read from lies a little further along the curve: by twice
/// as much as the lock may be off, or where there is none by a fraction of the part [-].
double change_along_the_curve(const Results& results, const RelativeErrors& errors) {
  constexpr double kOfLock = 2.0,
                   kFurther = 0.3;  // chosen with the constants of relative_errors (settings/measured.hpp)
  const std::optional<LockedPart>& part = results.curve.locked;
  if (!part || !(part->width > 0.0) || part->stiffness == 0.0) return 0.0;
  const bool locks = results.lock_extension && errors.lock_extension;
  const double further = locks ? kOfLock * *errors.lock_extension * *results.lock_extension / part->width : kFurther;
  return std::abs(part->change / part->stiffness) * further;
}

/// What the cell's noise makes of a stiffness, at 95 % [-]. Each of its three slopes, from n/3 readings over a third of
/// the width w, has a standard deviation of (12/(n/3))^1/2 noise/(w/3), and the middle one of them 0.67 times that.
double noise_of_stiffness(const Results& results, double noise) {
  const std::optional<LockedPart>& part = results.curve.locked;
  if (!part || !(part->width > 0.0) || part->stiffness == 0.0) return 0.0;
  return std::abs(1.96 * 0.67 * std::sqrt(36.0 / part->points) * noise / (part->width / 3.0) / part->stiffness);
}

/// The relative error of the largest load. Where the rod parts in a knot, friction in the knot decides at which load,
/// as it decides the plateau; so it does where knots slide to the end. Where its bend helps to part it, the mesh of the
/// bend decides, too. A straight strand parts at the force that was
/// given. Behind a lock the load depends on where the lock is, and how steep it rises.
std::optional<double> error_of_peak(const Results& results, const RunFacts& facts, const RelativeErrors& errors) {
  if (!results.true_peak_force || results.motion_pattern == MotionPattern::kUntangling) return {};
  if (results.break_extension && errors.break_in_bend)
    return *errors.break_in_bend + errors.plateau_force.value_or(0.0);
  constexpr double kBreakOfAStrand = 2e-3;  // twice the scatter of nylon's loop
  const bool in_a_strand = results.break_place == BreakPlace::kStrand || results.break_place == BreakPlace::kGrip;
  if (in_a_strand && can_part(facts.material)) {
    // At high speed the last step passes the strength by more than that.
    const double passed = *results.true_peak_force / (facts.strands * *weakest(facts.material)) - 1.0;
    return std::max(kBreakOfAStrand, passed);
  }
  // Whether a rope that nearly locks slips or parts may hang on the mesh.
  const bool locks = !is_solid(facts.material) && !(*results.true_peak_force < facts.preload);
  if (errors.largest_load) return locks ? std::optional<double>() : errors.largest_load;
  if (results.break_place == BreakPlace::kKnot || slid_to_the_end(results)) return errors.plateau_force;
  if (!errors.locked_stiffness || !results.curve.locked_stiffness) return {};
  if (results.break_extension || !results.lock_extension || !errors.lock_extension) return errors.locked_stiffness;
  const double off = *errors.lock_extension * *results.lock_extension * *results.curve.locked_stiffness;
  return *errors.locked_stiffness + std::abs(off / *results.true_peak_force);
}

/// Empty where there is no reading, or where the error says nothing.
std::optional<double> error_of(const std::optional<double>& reading, const std::optional<double>& share) {
  if (!reading || !share || *share > kMeaningless) return std::nullopt;
  return std::abs(*reading) * *share;
}

}  // namespace

std::string why_not_at_rest(const Results& results, const RunFacts& facts) {
  if (!results.not_equilibrated.empty() || !results.at_start) return results.not_equilibrated;
  const GripForces& start = *results.at_start;
  const double larger = std::max(std::abs(start.upper), std::abs(start.lower));
  const double reading = results.true_plateau_force.value_or(results.true_peak_force.value_or(0.0));
  const double most = std::max(kOfStart * larger, kOfReading * std::abs(reading)) + kDifferByWeight * facts.weight;
  if (!(start.difference() > most)) return {};
  return "the specimen was not at rest as its pull began: its grips bore " + short_number(start.upper) + " and " +
         short_number(start.lower) + " N, which " +
         (facts.weight > 0.0 ? "at rest differ by at most " + short_number(kDifferByWeight * facts.weight) + " N"
                             : "would be the same at rest") +
         "; hold it longer before, or pull more slowly";
}

bool slid_to_the_end(const Results& results) {
  return results.motion_pattern == MotionPattern::kSliding && !results.lock_extension;
}

bool knots_hardly_closed(const Results& results, const RunFacts& facts) {
  return facts.errors.plateau_force && results.true_plateau_force &&
         hardly_closed(*results.true_plateau_force, facts.material);
}

ReadingErrors known_errors(const Results& results, const RunFacts& facts) {
  if (!why_not_at_rest(results, facts).empty() || results.curve.jump_force || results.opened_when_mounted) return {};
  RelativeErrors share = knots_hardly_closed(results, facts) ? errors_of_hardly_closed(facts.errors) : facts.errors;
  // Studied are locks that the knots have come to, not loads that rise while they still slide.
  if (slid_to_the_end(results)) share.locked_stiffness.reset();
  if (share.locked_stiffness) *share.locked_stiffness += change_along_the_curve(results, share);
  const double speed = results.rate.drag.value_or(0.0) + results.rate.inertia.value_or(0.0);
  for (std::optional<double>* error : {&share.plateau_force, &share.locked_stiffness, &share.largest_load})
    if (*error) **error += speed;
  const std::optional<double> of_peak = error_of_peak(results, facts, share);
  if (share.locked_stiffness) *share.locked_stiffness += noise_of_stiffness(results, facts.load_cell.noise);
  return {error_of(results.true_plateau_force, share.plateau_force),
          error_of(results.lock_extension, share.lock_extension),
          error_of(results.curve.locked_stiffness, share.locked_stiffness), error_of(results.true_peak_force, of_peak)};
}

}  // namespace knot_utm
