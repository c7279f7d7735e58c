#include "knot_utm/io/null_reasons.hpp"

#include <algorithm>
#include <array>

#include "knot_utm/numeric/number.hpp"

namespace knot_utm {
namespace {

template <std::size_t N>
bool one_of(const std::string& key, const std::array<const char*, N>& keys) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

constexpr std::array kOfBreak{"break_extension", "break_arclength", "energy_to_break"};
constexpr std::array kOfJump{"jump_force", "jump_extension", "force_after_jump", "true_jump_force",
                             "true_force_after_jump"};
constexpr std::array kOfHold{"hold_force_begin", "hold_force_end", "relaxation"};
constexpr std::array kOfPlateau{
    "plateau_force", "plateau_force_sd", "plateau_force_low",  "plateau_force_high",   "plateau_force_slope",
    "plateau_slope", "breakaway_force",  "true_plateau_force", "true_breakaway_force", "plateau_load_cell_error"};
constexpr std::array kOfKnots{"tied_knot_distance", "excess_length", "final_excess_length"};

std::string why_no_lock(const Results& results) {
  if (results.curve.jump_force)
    return "a knot jumped open at " + short_number(*results.curve.jump_force) +
           " N, and the load-extension curve after it is that of another knot";
  if (results.opened_when_mounted) return "a knot opened as the loop was mounted";
  switch (results.motion_pattern) {
    case MotionPattern::kSliding:
      return "the knots still slid at the end of the pull";
    case MotionPattern::kStretching:
      return "the motion pattern is stretching";
    case MotionPattern::kUntangling:
      return "the knot came undone";
    case MotionPattern::kNone:
      break;
  }
  return "there are no two knots that could lock";
}

std::string why_no_error(const std::string& reading, const Results& results, const RunFacts& facts) {
  if (!results.not_equilibrated.empty()) return "the specimen was not at rest before it was pulled";
  if (results.curve.jump_force) return "a knot jumped open, which no convergence study covers";
  if (results.opened_when_mounted) return "a knot opened as the loop was mounted, which no convergence study covers";
  const std::string none = why_null(reading, results, facts);
  if (none.empty() && slid_to_the_end(results) && reading == "locked_stiffness") return why_no_lock(results);
  return none.empty() ? "no convergence study covers this case" : none;
}

std::string why_no_stiffness(const Results& results) {
  if (results.curve.jump_force || results.opened_when_mounted || results.motion_pattern != MotionPattern::kSliding)
    return why_no_lock(results);
  if (results.curve.rises_at) return "the load was read fewer than three times between the lock and the peak";
  return results.lock_extension ? "the lock does not show in the load" : why_no_lock(results);
}

/// Of what any pull has.
std::string why_not_of_the_pull(const std::string& key, const Results& results) {
  if (key == "lock_extension") return results.lock_extension ? "" : why_no_lock(results);
  if (key == "lock_extension_by_load") return results.curve.no_lock_by_load;
  if (key == "locked_stiffness") return results.curve.locked_stiffness ? "" : why_no_stiffness(results);
  if (key == "chord_stiffness") return "the true force was never below a tenth of the peak";
  if (key == "first_contact_extension") return "no two knots touched each other while pulled";
  if (key == "roller_touched_at") return "no roller bore on a knot or its tail while pulled";
  if (key == "largest_drop") return "the load was read fewer than 20 times before the lock";
  if (key == "largest_drop_at")
    return results.curve.largest_drop ? "the load only rose before the lock"
                                      : why_not_of_the_pull("largest_drop", results);
  return {};
}

}  // namespace

bool slid_to_the_end(const Results& results) {
  return results.motion_pattern == MotionPattern::kSliding && !results.lock_extension;
}

std::string why_null(const std::string& key, const Results& results, const RunFacts& facts) {
  if (key == "load_cell_error")
    return results.true_peak_force ? "the load cell has neither accuracy nor floor" : "nothing was pulled";
  if (key == "plateau_load_cell_error" && results.true_plateau_force)
    return "the load cell has neither accuracy nor floor";
  if (one_of(key, kOfPlateau)) return results.curve.no_plateau.empty() ? "" : "see no_plateau_because";
  for (const char* reading : {"plateau_force", "lock_extension", "locked_stiffness"})
    if (key == std::string(reading) + "_error") return why_no_error(reading, results, facts);
  if (one_of(key, kOfBreak)) return results.break_extension ? "it did not break in a pull" : "the rod did not break";
  if (one_of(key, kOfJump)) return "no knot jumped open";
  if (one_of(key, kOfHold)) return "the crosshead was not held under a load";
  if (one_of(key, kOfKnots)) return "there are no two knots";
  if (key == "margin_friction" || key == "margin_preload")
    return facts.margin.reason.empty() ? "the method does not ask for analysis.margin" : facts.margin.reason;
  if (key == "hysteresis") return "no cycle was closed";
  if (key == "untangled_at") return "the knot did not come undone";
  if (key == "failure_mode") return "the specimen did not fail";
  if (key == "no_plateau_because") return "there is a plateau";
  if (key == "preload") return "nothing was tied";
  if (key == "peak_memory") return "not known";
  if (key == "specification_passed") return "the method has no specification";
  if (!results.true_peak_force && key != "reason") return "nothing was pulled";
  return why_not_of_the_pull(key, results);
}

}  // namespace knot_utm
