#pragma once

#include <optional>
#include <string>

#include "knot_utm/machine/break_watch.hpp"
#include "knot_utm/machine/fracture.hpp"
#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/record/ended_by.hpp"

namespace knot_utm {

class Grips;
class TimeStep;

/// Follows a specimen that can part from step to step: when it parts (break_watch.hpp), at which edge (fracture.hpp),
/// and in which words.
class RodBreak {
 public:
  /// `stepper` has made no step yet. `shortest`: as of BreakWatch [s].
  RodBreak(const Material& material, const TimeStep& stepper, double shortest);

  /// Says why a step that was solved, and would end at `end` after dt [s], is refused; empty where it is accepted.
  std::string refuse(const TimeStep& stepper, const Points& end, double dt) const;

  /// To be called after every accepted step. What parts the rod there; none: it holds, and `next` is how long the next
  /// step may be [s].
  std::optional<Exposure> judge(const TimeStep& stepper, double dt);
  double next() const { return watch_.next(); }

  /// Where along the rod, in which rope, in what kind of place, and at which tension or strain.
  std::string describe(const TimeStep& stepper, const Exposure& reached, BreakPlace place) const;

  void state(Archive& archive) { archive(watch_); }

 private:
  Exposure exposure(const TimeStep& stepper, const Points& position, double dt) const;

  RopeStrengths strengths_;
  BreakWatch watch_;
};

/// `grip`: how far the upper grip has moved [m].
BreakPlace place_of_break(const TimeStep& stepper, const Grips& grips, double grip, int edge);

/// From the first end of the rod to the middle of a parted edge [m].
double break_arclength(const TimeStep& stepper, int edge);

}  // namespace knot_utm
