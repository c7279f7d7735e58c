#pragma once

#include <vector>

#include "knot_utm/numeric/index.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/force_term.hpp"
#include "knot_utm/sim/scene.hpp"
#include "knot_utm/sim/step_account.hpp"
#include "knot_utm/sim/step_matrix.hpp"

namespace knot_utm {

/// Inertia, gravity and viscous drag of the nodes: a force term (force_term.hpp).
///
///   f_i = m_i (g - (x_i - x_n - dt v_n)/dt^2) - c lbar_i (x_i - x_n)/dt      [N]
///   -df_i/dx_i = m_i/dt^2 + c lbar_i/dt                                      [N/m]
///
/// Here m_i is the mass, g the gravity, lbar_i the Voronoi length, and c the drag coefficient per length, the sum of
/// that of the scene and that of the boundary.
class MotionTerm : public ForceTerm {
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

/// Slipping grips, spring holds and given forces, which act on single nodes (scene.hpp): a force term (force_term.hpp).
/// It keeps no state from step to step.
struct GripTerm : ForceTerm {
  void add_forces(const StepStart& start, const Points& x, std::vector<Lanes>& force) const {
    for (const SlippingGrip& grip : start.boundary.grips)
      force[at(grip.node)] += to_lanes(grip.force(x.col(grip.node)) * grip.direction);
    for (const SpringHold& hold : start.boundary.holds) force[at(hold.node)] += to_lanes(hold.force(x.col(hold.node)));
    for (const NodeForce& given : start.boundary.forces) force[at(given.node)] += to_lanes(given.force);
  }

  template <int D>
  void add_stiffness(LinearSystem<D>& system) const {
    for (const SlippingGrip& grip : system.start.boundary.grips) {
      const Vec3 x = system.x.col(grip.node);
      if (grip.force(x) <= 0.0 || grip.slips(x)) continue;
      add(system.matrix.band(grip.node, 0, 0), grip.direction * grip.direction.transpose(), grip.stiffness);
    }
    for (const SpringHold& hold : system.start.boundary.holds)
      add(system.matrix.band(hold.node, 0, 0), hold.stiffness, 1.0);
  }

  /// All of its work is work of the boundary, by the forces at the end of the step.
  void account(const SolvedStep& step, StepAccount& account) const {
    const auto enter = [&](int node, const Vec3& force, double work) {
      account.work.boundary += work;
      account.loads.add(step.end.col(node), force);
    };
    for (const SlippingGrip& grip : step.boundary.grips) {
      const double force = grip.force(step.end.col(grip.node));
      enter(grip.node, force * grip.direction, force * grip.direction.dot(step.increment.col(grip.node)));
    }
    for (const SpringHold& hold : step.boundary.holds) {
      const Vec3 force = hold.force(step.end.col(hold.node));
      enter(hold.node, force, force.dot(step.increment.col(hold.node)));
    }
    for (const NodeForce& given : step.boundary.forces)
      enter(given.node, given.force, given.force.dot(step.increment.col(given.node)));
  }
};

}  // namespace knot_utm
