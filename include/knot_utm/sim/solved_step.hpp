#pragma once

#include <vector>

#include "knot_utm/numeric/lanes.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

struct Boundary;
struct RodState;

/// The start and the boundary of one time step. All of it stays unchanged until the step has ended.
struct StepStart {
  const RodState& state;     ///< x_n, v_n and the frames
  const Boundary& boundary;  ///< as it stands at the end of the step
  double dt;                 ///< [s]
};

/// A step whose equations are solved, before the state is advanced.
struct SolvedStep : StepStart {
  const Points& end;        ///< x [m]
  const Points& increment;  ///< x - x_n [m]
  /// Sum of all forces except those of holders [N], and of torques about an edge's tangent [N m]. On free unknowns it
  /// is the imbalance that Newton's method left, on held ones the negative force of the holder.
  const std::vector<Lanes>& force;
  const std::vector<char>& held;  ///< which nodes are
};

}  // namespace knot_utm
