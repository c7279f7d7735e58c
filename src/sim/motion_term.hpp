#pragma once

#include <vector>

#include "force_term.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/scene.hpp"
#include "knot_utm/sim/solved_step.hpp"
#include "knot_utm/sim/step_account.hpp"

namespace knot_utm {

/// Inertia, gravity and viscous drag of the nodes: a force term (force_term.hpp).
///
///   f_i = m_i (g - (x_i - x_n - dt v_n)/dt^2) - c lbar_i (x_i - x_n)/dt      [N]
///   -df_i/dx_i = m_i/dt^2 + c lbar_i/dt                                      [N/m]
///
/// Here m_i is the mass, g the gravity, lbar_i the Voronoi length, and c the drag coefficient per length, the sum of
/// that of the scene and that of the boundary.
class MotionTerm {
 public:
  /// Both arguments must outlive this object. Gravity and drag in `settings` may change between two steps.
  MotionTerm(const RodProperties& rod, const StepSettings& settings);

  void add_forces(const StepStart& start, const Points& x, std::vector<Lanes>& force) const;
  template <int D>
  void add_stiffness(LinearSystem<D>& system) const;
  void account(const SolvedStep& step, StepAccount& account) const;

 private:
  double drag(const Boundary& boundary) const { return settings_.drag + boundary.extra_drag; }

  const RodProperties& rod_;
  const StepSettings& settings_;
};

}  // namespace knot_utm
