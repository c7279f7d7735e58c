#pragma once

#include "knot_utm/breaking/breaking_laws.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/verdict/known_errors.hpp"
#include "knot_utm/verdict/result_keys.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {

// Reasons why a key of result.yaml is null, where the reason depends on the test. The rows of result_keys() refer to
// them. They are evaluated only for keys that have no value.

inline constexpr const char* kNoClass = "the load cell has neither accuracy nor floor";
inline constexpr const char* kFewForDrops = "the load was read fewer than 20 times before the lock";

inline bool ended_in_plateau(const Results& results) { return results.ended_by == EndedBy::kPlateau; }

/// Empty: something was pulled.
inline std::string why_not_pulled(const ResultSource& source) {
  if (source.results.true_peak_force) return "";
  return source.results.never_in_tension ? "the specimen was never in tension" : "nothing was pulled";
}

/// Empty: something was pulled, to the end of the pull.
inline std::string why_no_whole_pull(const ResultSource& source) {
  const std::string not_pulled = why_not_pulled(source);
  return not_pulled.empty() && ended_in_plateau(source.results) ? kEndedInPlateau : not_pulled;
}

/// `reason` of a reading that any whole pull has.
inline std::string of_the_pull(const ResultSource& source, const std::string& reason) {
  const std::string not_pulled = why_no_whole_pull(source);
  return not_pulled.empty() ? reason : not_pulled;
}

std::string NullReason::operator()(const ResultSource& source) const {
  return of_a_pull_ ? of_the_pull(source, always_) : find_ ? find_(source) : always_;
}

inline std::string why_no_break(const ResultSource& source) {
  if (source.results.break_extension) return "it did not break in a pull";
  return source.results.break_place == BreakPlace::kNone ? "the rod did not break"
                                                         : "the rod parted before anything pulled it";
}

inline std::string why_no_peak(const ResultSource& source) {
  return of_the_pull(source, source.results.curve.peak_force ? "" : "the load never rose above its balanced zero");
}

inline std::string why_they_did_not_lock(const Results& results) {
  if (results.knot_type == KnotType::kCrossed) return "the rod ran through itself";
  if (results.untangled_at) return "the knot came undone";
  if (results.curve.jump_force)
    return "a knot jumped open at " + short_number(*results.curve.jump_force) +
           " N, and the load-extension curve after it is that of another knot";
  switch (results.motion_pattern) {
    case MotionPattern::kSliding:
      return ended_in_plateau(results) ? kEndedInPlateau : "the knots still slid at the end of the pull";
    case MotionPattern::kStretching:
      return "the motion pattern is stretching";
    case MotionPattern::kUntangling:
      return "a knot opened as the loop was mounted";
    case MotionPattern::kNone:
      break;
  }
  return "only two knots that slide towards each other lock, and there are none";
}

inline std::string why_the_load_has_no_stiffness(const Results& results) {
  if (results.motion_pattern == MotionPattern::kNone && !results.curve.jump_force)
    return "the load has no rise with three readings or more";
  if (results.curve.jump_force || results.motion_pattern != MotionPattern::kSliding)
    return why_they_did_not_lock(results);
  if (results.curve.rises_at) return "the load was read fewer than three times between the lock and the peak";
  return results.lock_extension ? "the lock does not show in the load" : why_they_did_not_lock(results);
}

/// `no_reading`: why there is no reading that could be off; empty: there is one. `error`: that of mesh and tolerances,
/// or none; where it is known, it is larger than half of the reading if a reading has no error all the same.
inline std::string why_no_error(const ResultSource& source, const std::string& no_reading,
                                std::optional<double> RelativeErrors::*error) {
  const Results& results = source.results;
  const bool hardly_closed = knots_hardly_closed(results, source.facts);
  const RelativeErrors errors = hardly_closed ? errors_of_hardly_closed(source.facts.errors) : source.facts.errors;
  const bool studied = error && errors.*error;
  if (!why_not_at_rest(results, source.facts).empty()) return "unknown: the specimen was not at rest as its pull began";
  if (results.curve.jump_force) return "unknown: a knot jumped open, which no convergence study covers";
  if (results.opened_when_mounted)
    return "unknown: the knots moved as the loop was mounted, which no convergence study covers";
  if (hardly_closed && !studied) return "unknown: the knots were hardly closed, which no convergence study covers";
  if (!no_reading.empty()) return no_reading;
  return studied ? "unknown: the estimate is more than half of the reading"
                 : "unknown: no convergence study covers this case";
}

inline std::string why_no_plateau(const ResultSource& source) {
  return source.results.curve.no_plateau.empty() ? "" : "see no_plateau_because";
}

inline std::string why_no_plateau_error(const ResultSource& source) {
  return why_no_error(source, why_no_plateau(source), &RelativeErrors::plateau_force);
}

inline std::string why_no_place_of_drop(const ResultSource& source) {
  return source.results.curve.largest_drop ? of_the_pull(source, "the load only rose before the lock")
                                           : of_the_pull(source, kFewForDrops);
}

inline std::string why_no_lock(const ResultSource& source) {
  return of_the_pull(source, source.results.lock_extension ? "" : why_they_did_not_lock(source.results));
}

inline std::string why_no_lock_error(const ResultSource& source) {
  return why_no_error(source, why_no_lock(source), &RelativeErrors::lock_extension);
}

inline std::string why_no_lock_by_load(const ResultSource& source) {
  return of_the_pull(source, source.results.curve.no_lock_by_load);
}

inline std::string why_no_stiffness(const ResultSource& source) {
  const Results& results = source.results;
  return of_the_pull(source, results.curve.locked_stiffness ? "" : why_the_load_has_no_stiffness(results));
}

inline std::string why_no_stiffness_error(const ResultSource& source) {
  const std::string no_reading = why_no_stiffness(source);
  const bool slides = no_reading.empty() && slid_to_the_end(source.results);
  return why_no_error(source, slides ? why_they_did_not_lock(source.results) : no_reading,
                      &RelativeErrors::locked_stiffness);
}

inline std::string why_no_peak_error(const ResultSource& source) {
  return why_no_error(source, why_no_peak(source), nullptr);
}

inline std::string why_no_snap(const ResultSource& source) {
  const std::string not_pulled = why_not_pulled(source);
  if (!not_pulled.empty()) return not_pulled;
  return source.results.tied_knot_distance ? "a loop of two knots has jump_force" : "nothing snapped";
}

inline std::string why_no_efficiency(const ResultSource& source) {
  if (!source.facts.may_hold_a_knot) return "there is no knot";
  if (!source.results.break_extension) return why_no_break(source);
  if (!all_part_by_bending(source.facts.material))
    return "not predicted: the rod parts where its tension is material.breaking_force, which was given";
  return of_the_pull(source, "the load fell before the rod parted");
}

inline std::string why_no_hole(const ResultSource& source) {
  if (!source.facts.one_knot_in_a_strand) return "the specimen is no strand with one knot";
  if (source.results.break_place != BreakPlace::kNone) return "the rod broke";
  if (!source.facts.ends_with_hold) return "the test does not end with a hold, in which a knot is measured";
  return source.results.knot_type == KnotType::kKept ? "no shape of the rod is known" : "the knot is another one";
}

inline std::string why_no_cell_error_in_plateau(const ResultSource& source) {
  return source.results.true_plateau_force ? kNoClass : why_no_plateau(source);
}

}  // namespace knot_utm
