#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "knot_utm/sim/centreline_terms.hpp"
#include "knot_utm/sim/scene.hpp"

namespace knot_utm {

/// The largest residual of a trial, and its node: that of an edge is the node before it.
struct WorstResidual {
  double residual = 0.0;  ///< divided by the node's tolerance scaling; of an edge its torque over the radius [N]
  int node = -1;          ///< -1: none, because all nodes are held
};

/// The norm in which Newton's method measures a residual: its tolerance, and the scaling of the tolerance by the
/// tension at a node.
///
///   tolerance  max(s clamp(l T, r/100, r), r/1000), s = min(1, (dt/t_r)^2 (1 + c dt/m))
///   scaling    1 + a T_i / tolerance: factor by which the residual of node i may exceed the tolerance
///
/// Symbols: r residual [N], l residual_at_little_tension (0: r replaces the clamp), a residual_of_tension, t_r
/// residual_from_step [s]; T largest tension of the rod and T_i that of the edges of node i [N]; c drag and m mass per
/// length [kg/m].
///
/// The imbalance that is left in each step excites vibrations of the rod, more so the shorter the steps are, and
/// vibrations keep the steps short. The tolerance therefore falls with dt^2. The tension of a node's own edges is used
/// for the scaling, because a locked knot carries kilonewtons beside tails that a very small force moves. While a shape
/// settles, its drag reduces the effect of the imbalance by 1 + c dt/m, and s is larger by this factor.
class ResidualNorm {
 public:
  explicit ResidualNorm(const StepSettings& settings)
      : residual_(settings.residual),
        from_step_(settings.residual_from_step),
        of_tension_(settings.residual_of_tension),
        at_little_tension_(settings.residual_at_little_tension) {}

  /// `held_back`: c dt/m.
  double tolerance(double tension, double dt, double held_back) const {
    const double short2 = dt * dt * (1.0 + held_back), full2 = from_step_ * from_step_;
    const double part = short2 < full2 ? short2 / full2 : 1.0;
    return std::max(part * loose(tension), kInShortSteps * residual_);
  }
  double scaling(double tension_at_node, double tolerance) const {
    return 1.0 + of_tension_ * tension_at_node / tolerance;
  }

  /// The largest scaled residual of the nodes that are not held. A residual that is not finite is returned at once.
  template <typename Held>
  WorstResidual worst_of_nodes(const std::vector<Lanes>& force, const CentrelineTerms& centreline, double tolerance,
                               const Held& held) const {
    WorstResidual out;
    double largest2 = 0.0;
    for (int i = 0; i < static_cast<int>(force.size()); ++i) {
      if (held.holds(i)) continue;
      const Lanes& f = force[static_cast<std::size_t>(i)];
      const double size2 = f[0] * f[0] + f[1] * f[1] + f[2] * f[2];
      const double scaling = this->scaling(centreline.largest_tension_at(i), tolerance);
      if (!std::isfinite(size2)) return {size2, i};
      const double scaled2 = size2 / (scaling * scaling);
      if (out.node >= 0 && scaled2 <= largest2) continue;
      largest2 = scaled2;
      out.node = i;
    }
    out.residual = std::sqrt(largest2);
    return out;
  }

  /// The same for the torques, divided by `radius`, on edges whose frames are not held. Returns `worst` where none is
  /// larger.
  template <typename Frames>
  static WorstResidual worst_of_spins(const std::vector<Lanes>& force, const Frames& frames, double radius,
                                      WorstResidual worst) {
    for (int i = 0; i + 1 < static_cast<int>(force.size()); ++i) {
      if (frames.held(i)) continue;
      const double size = std::abs(force[static_cast<std::size_t>(i)][3]) / radius;
      if (!std::isfinite(size)) return {size, i};
      if (size > worst.residual) worst = {size, i};
    }
    return worst;
  }

 private:
  static constexpr double kInShortSteps = 1e-3, kAtLittleTension = 1e-2;  // lower bounds, as fractions of r

  double loose(double tension) const {
    if (at_little_tension_ <= 0.0) return residual_;
    return std::clamp(at_little_tension_ * tension, kAtLittleTension * residual_, residual_);
  }

  double residual_, from_step_, of_tension_, at_little_tension_;
};

}  // namespace knot_utm
