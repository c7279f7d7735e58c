#pragma once

#include <optional>
#include <string>
#include <vector>

#include "knot_utm/breaking/breaking_laws.hpp"
#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/record/ended_by.hpp"
#include "knot_utm/sim/contact_force.hpp"

namespace knot_utm {

struct RodProperties;
class TimeStep;

/// How near a rod is to parting, and at which edge. It parts there when the fraction reaches 1.
struct Exposure {
  double fraction = 0.0;  ///< of the breaking law (breaking_laws.hpp) [-]
  int edge = -1;  ///< edge at which it is largest; -1: it is positive nowhere, because no edge is stretched or bent
  BreakLimit limit = BreakLimit::kForce;
  double value = 0.0;  ///< of the quantity that is limited: tension [N] or strain of the outermost fibre [-]
};

/// The curvature kappa of an edge is that at its more bent end, there the mean along a diameter of rod:
///
///   kappa = |sum_i phi_i w_i|/(2 h)
///
///   phi_i  the turn at node i, as a vector along its axis [rad]
///   w_i    the share of its Voronoi length that lies within h of the end, along the rod at rest [-]
///
/// Without the mean, the largest curvature of a limp rope would grow as edges get shorter (doc/model.md, section 8,
/// "The rod parts"). Cut edges, and the ends of ropes, are not bent.
///
/// The force per length p that presses an edge flat is the mean along the same diameter, at the end where it is larger.
/// Forces from one side count in full, because tension holds the section against them; two opposite forces count once:
///
///   p = (sum_i w_i |f|_i + |sum_i w_i f_i|)/(4 h)
///
///   f_i, |f|_i  sum of the normal forces of contacts at node i, and of their sizes (Pressing) [N]
class RopeStrengths {
 public:
  /// Only ropes that can part count, each by the breaking law of its material.
  RopeStrengths(const Material& material, const RodProperties& rod);

  /// Whether one of the laws takes the pressing of contacts into account.
  bool crush() const;

  /// `pressing`: of all nodes; needed if crush().
  Exposure most_exposed(const RodProperties& rod, const Points& position, const Pressing& pressing = {}) const;

 private:
  struct Ropes {
    BreakingLaws law;
    Eigen::Index begin, end;  // their edges
  };
  std::vector<Ropes> ropes_;
};

/// Whether another strand lies against an edge, nearer than 1.1 (h_a + h_b) to it and further than 5 h along the rod.
bool lies_in_knot(const RodProperties& rod, const Points& position, int edge);

/// Judges time steps of a rod that can part. A step should end just when the rod parts. A step that leads to a multiple
/// of the strength is too long, or wrong: it is refused and tried again at half its length. A run whose shortest step
/// is refused is given up.
class BreakWatch {
 public:
  /// `shortest`: steps are no shorter than this for a break that is near [s]. `start`: exposure before the first step.
  BreakWatch(double shortest, const Exposure& start) : shortest_(shortest), before_(start.fraction) {}

  /// Reason to refuse a step that would lead to this exposure in the time dt [s]; empty: it is accepted.
  std::string refuse(const Exposure& to, double dt) const;

  /// To be called after every accepted step. Returns whether the rod has parted. If not, next() is the longest step
  /// that may follow.
  bool judge(const Exposure& now, double dt);
  double next() const { return next_; }  ///< [s]

  void state(Archive& archive) { archive(before_); }

 private:
  double shortest_;
  double before_;  ///< fraction of the exposure after the last accepted step
  double next_ = 0.0;
};

/// Reason why a rod that seems to part by tension cannot have parted: the rod pushes on both grips, as their forces
/// `upper` and `lower` are negative [N]. Empty: it may have parted. It may push on one grip by its weight, and slightly
/// on both by the residual of the solver.
std::string not_by_tension(const Exposure& parted, double upper, double lower);

/// Follows a specimen that can part from step to step: when it parts (BreakWatch), at which edge (Exposure), and what
/// is said about it.
class RodBreak {
 public:
  /// `stepper` has made no step yet. `shortest`: as of BreakWatch [s].
  RodBreak(const Material& material, const TimeStep& stepper, double shortest);

  /// Reason to refuse a step that was solved and would end at the positions `end` after dt [s]; empty: it is accepted.
  std::string refuse(const TimeStep& stepper, const Points& end, double dt) const;

  /// To be called after every accepted step. The exposure at which the rod parts; empty: it holds, and next() is the
  /// longest step that may follow [s].
  std::optional<Exposure> judge(const TimeStep& stepper, double dt);
  double next() const { return watch_.next(); }

  /// Message: where along the rod, in which rope, in what kind of place, and at which tension or strain it parted.
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
