#pragma once

#include <optional>
#include <string>

#include "knot_utm/breaking/fracture.hpp"
#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/record/ended_by.hpp"

namespace knot_utm {

class TimeStep;

/// Judges time steps of a rod that can part. A step should end where the rod parts, and no rod parts in a step that
/// takes it to a multiple of its strength: such a step is too long, or wrong. It is refused, so that it is tried again
/// at half its length; a run whose shortest step is refused is given up.
class BreakWatch {
 public:
  /// `shortest`: steps are no shorter than this for a break that is near [s]. `start`: exposure before the first step.
  BreakWatch(double shortest, const Exposure& start) : shortest_(shortest), before_(start.fraction) {}

  /// Says why a step is refused that would lead to an exposure in the time dt [s]; empty where it is accepted.
  std::string refuse(const Exposure& to, double dt) const;

  /// To be called after every accepted step. Returns whether the rod has parted. Where it has not, `next` is how long
  /// the next step may be.
  bool judge(const Exposure& now, double dt);
  double next() const { return next_; }  ///< [s]

  void state(Archive& archive) { archive(before_); }

 private:
  double shortest_;
  double before_;  ///< fraction of the exposure after the last accepted step
  double next_ = 0.0;
};

/// Why a rod cannot have parted, or empty: by tension while both grips are pressed together, by the forces `upper` and
/// `lower` < 0 [N]. One grip alone may be pressed by the rod's weight, and both by what an iteration leaves.
std::string not_by_tension(const Exposure& parted, double upper, double lower);

/// Follows a specimen that can part from step to step: when it parts (BreakWatch), at which edge (fracture.hpp), and in
/// which words.
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
  Exposure exposure(const TimeStep& stepper, const Points& position) const;

  RopeStrengths strengths_;
  BreakWatch watch_;
};

/// From the first end of the rod to the middle of a parted edge [m].
double break_arclength(const TimeStep& stepper, int edge);

}  // namespace knot_utm
