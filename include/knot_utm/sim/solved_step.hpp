#pragma once

#include <vector>

#include "knot_utm/numeric/lanes.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/scene.hpp"

namespace knot_utm {

/// What one time step starts from and must meet. All of it stays unchanged until the step has ended.
struct StepStart {
  const RodState& state;     ///< x_n, v_n and the frames
  const Boundary& boundary;  ///< as it stands at the end of the step
  double dt;                 ///< [s]
};

/// A step as its equations were solved, before the state moves on.
struct SolvedStep : StepStart {
  const Points& end;        ///< x [m]
  const Points& increment;  ///< x - x_n [m]
  /// All forces but those of holders, [N] and about an edge's tangent [N m]: what is left unbalanced on what is free,
  /// on what is held the opposite of what holds it.
  const std::vector<Lanes>& force;
  const std::vector<char>& held;  ///< which nodes are
};

}  // namespace knot_utm
