#pragma once

#include <array>
#include <vector>

#include "knot_utm/sim/time_step.hpp"

namespace knot_utm {

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
