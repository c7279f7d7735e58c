#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/record/per_knot.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/time_step.hpp"
#include "knot_utm/specimen/centreline.hpp"

/// Where the knot is: what its file reads of it, what of its tails is left outside it, and what the two knots of a loop
/// touch.
namespace knot_utm {

/// What a knot's file reads of the knot. Its lengths are those of the rod at rest.
///
/// Two places of the rod touch where the polylines through its nodes are nearer to each other than 1.05 times both
/// radii together, and more than 3 pi/2 radii of rod lie between them. Strands that press on each other are nearer by a
/// clear margin, so that a touch does not come and go with the force of a contact, and the place at which strands begin
/// to touch moves along the rod as smoothly as the strands do. Posts do not count.
class KnotReadings {
 public:
  KnotReadings(const Centreline& centreline, const RodProperties& rod);

  /// In the order of the file [m]; unknown where the rope touches nothing before its end.
  PerKnot at(const Points& position) const;

 private:
  /// Edges in the order of their height, of which those near a place are neighbours.
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

/// The tails of a knot: how much of each free end is left outside it. A tail ends where, from its end on, its rope has
/// borne a twentieth of all normal force of strands on the rope. This place moves along the rod smoothly, which that of
/// the first contact does not. Posts do not count: that of a hitch bears most where the load comes in, so that a
/// twentieth of its force is borne by turns in the middle of the rope, and further along the more the load grows. Only
/// of a rope that is wound around posts, and whose strands have never touched, they are all that there is.
class FreeEnds {
 public:
  FreeEnds(const Centreline& centreline, const RodProperties& rod);

  /// Of each free end, in the order along the rod [m]; unknown where its rope touches nothing that counts, or no rope
  /// of several touches another.
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
/// (OverhandStrand); the other knot's strand, which runs through it, is no part of it. The knots touch each other where
/// one coil touches the other. A knot or its tail lies on a roller where the strand from that outermost point to the
/// tail's end does. Where a strand no longer turns back and forth, its coil is taken where it was last found.
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
