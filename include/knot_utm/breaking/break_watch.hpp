#pragma once

#include <optional>
#include <string>
#include <vector>

#include "knot_utm/breaking/breaking_laws.hpp"
#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/record/ended_by.hpp"
#include "knot_utm/rod/stretching.hpp"
#include "knot_utm/sim/contact_force.hpp"
#include "knot_utm/specimen/material.hpp"

namespace knot_utm {

/// How near a rod is to parting, and at which edge. It parts there when the fraction reaches 1.
struct Exposure {
  double fraction = 0.0;  ///< that of the breaking law (tension_breaking.hpp, fibre_breaking.hpp) [-]
  int edge = -1;          ///< where it is largest; -1: nowhere positive, because no edge is under tension or bent
  BreakLimit limit = BreakLimit::kForce;
  double value = 0.0;  ///< the quantity that is limited: tension [N] or strain of the outermost fibre [-]
};

/// The curvature kappa of an edge is that at its more bent end, there the mean along a diameter of rod:
///
///   kappa = |sum_i phi_i w_i|/(2 h)
///
///   phi_i  the turn at node i, as a vector along its axis [rad]
///   w_i    the share of its Voronoi length that lies within h of the end, along the rod at rest [-]
///
/// A rod bends no sharper than its section is wide. Without the mean, a limp rope would be bent over a length of
/// (k_b/T)^1/2 where a strand presses on it, some hundredths of h at the loads that part it, so that the largest
/// curvature would grow as edges get shorter. Cut edges, and ends of ropes, bear nothing.
///
/// The force that presses it flat is the mean along the same diameter, at its more pressed end. Forces from one side
/// press on all of a section that tension holds against them, and those from two sides press once, not twice:
///
///   p = (sum_i w_i |f|_i + |sum_i w_i f_i|)/(4 h)
///
///   f_i, |f|_i  sum of the normal forces of contacts at node i, and of their sizes (Pressing) [N]
class RopeStrengths {
 public:
  /// By the breaking laws of the materials of its ropes, which say all about those that can part.
  RopeStrengths(const Material& material, const RodProperties& rod);

  /// Whether one of the laws asks for what contacts press with.
  bool crush() const;

  /// `pressing`: of all nodes, where one of the laws asks for it.
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

/// Follows a specimen that can part from step to step: when it parts (BreakWatch), at which edge (Exposure), and in
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
