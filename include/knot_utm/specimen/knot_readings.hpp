#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/record/per_knot.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/time_step.hpp"
#include "knot_utm/specimen/centreline.hpp"

/// Where the knot is: the lengths that its file asks for, its tails, and what the two knots of a loop touch.
namespace knot_utm {

/// The lengths of the knot that its file asks for, measured along the rod at rest.
///
/// Two places of the rod touch if the polylines through its nodes are nearer to each other than 1.05 times the sum of
/// both radii, and more than 3 pi/2 radii of rod lie between them. Strands that press on each other are clearly nearer,
/// so that a touch does not come and go with the contact force, and the place at which strands begin to touch moves as
/// smoothly along the rod as the strands do. Posts do not count.
class KnotReadings {
 public:
  KnotReadings(const Centreline& centreline, const RodProperties& rod);

  /// In the order of the file [m]; unknown where the rope touches nothing before its end.
  PerKnot at(const Points& position) const;

 private:
  /// A shape with its edges sorted by height, so that the edges near a place are found quickly.
  struct Shape {
    const Points& position;
    Points middle;                // of the edges [m]
    Eigen::VectorXd half_length;  // of the edges [m]
    std::vector<int> by_height;   // edges that are not cut
    double longest = 0.0;         // of the half lengths [m]
  };
  Shape shape_of(const Points& position) const;
  /// Arclength at rest of the first touch on the way from a node, up (1) or down (-1) the rod; unknown: there is none.
  double first_touch(int node, int step, const Shape& shape) const;

  std::vector<KnotReading> read_;
  Eigen::VectorXd arclength_;  // of the nodes [m]
  Eigen::VectorXd radius_;     // of the edges [m]; 0: it is cut
};

/// The tails of a knot: the length of each free end outside it. The normal forces between strands are summed along the
/// rope from its free end; the tail ends where the sum reaches a twentieth of the whole. Unlike the place of the first
/// contact, this place moves smoothly along the rod. Forces of posts do not count: the post of a hitch presses most
/// where the load comes in, so that the place would lie further along the more the load grows. They count only as long
/// as strands have never touched, as those of a rope that is merely wound around posts.
class FreeEnds {
 public:
  FreeEnds(const Centreline& centreline, const RodProperties& rod);

  /// Of each free end, in the order along the rod [m]; unknown if its rope touches nothing that counts, or if there are
  /// several ropes and none touches another.
  PerKnot lengths(const StepReadings& readings) const;
  /// After an accepted step: whether strands touch.
  void follow(bool touch) { touched_ |= touch; }

  void state(Archive& archive) { archive(touched_); }

 private:
  /// From an end at `begin` to the other end of its rope.
  struct Tail {
    int begin, end, step;
  };
  bool ropes_touch(const StepReadings& readings) const;
  double length(const Tail& tail, const Eigen::VectorXd& normal_force) const;

  std::vector<Tail> tails_;
  std::vector<NodeRange> ropes_;
  Eigen::VectorXd arclength_;  // of the nodes [m]
  bool touched_ = false;       // strands have
};

/// Contact of the two overhands of a loop with each other and with the rollers.
///
/// A knot's coil is its own strand from the outermost point, where it turns back, to the cut of its tail
/// (OverhandStrand), without the other knot's strand that runs through it. The knots touch each other if their coils
/// do. A knot or its tail lies on a roller if its strand does, between the outermost point and the end of the tail. If
/// a strand no longer turns back and forth, its coil stays where it was last found.
class KnotTouch {
 public:
  /// `standing`: as LoopTopology takes them, lower knot first. `radius`: of the rod [m]. `windings`: of each tail.
  KnotTouch(const std::vector<int>& standing, double radius, int windings);

  /// To be called after an accepted step, before the next one is tried.
  void follow(const TimeStep& stepper);

  double between_knots() const { return between_knots_; }  ///< sum of normal forces between the coils [N]
  double on_rollers() const { return on_rollers_; }        ///< of rollers on knots and tails [N]

  void state(Archive& archive);

 private:
  std::array<int, 2> standing_;
  double radius_;
  int windings_;
  std::array<NodeRange, 2> coil_{};  // none found yet: empty
  double between_knots_ = 0.0, on_rollers_ = 0.0;
};

}  // namespace knot_utm
