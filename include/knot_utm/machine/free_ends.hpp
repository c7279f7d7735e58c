#pragma once

#include <vector>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/record/per_knot.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/step_readings.hpp"
#include "knot_utm/specimen/centreline.hpp"

namespace knot_utm {

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

}  // namespace knot_utm
