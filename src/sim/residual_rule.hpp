#pragma once

#include <algorithm>

#include "knot_utm/sim/scene.hpp"

namespace knot_utm {

/// The tolerance of Newton's method, and its scaling by a node's tension.
///
///   tolerance  max(s clamp(l T, r/100, r), r/1000), s = min(1, (dt/t_r)^2 (1 + c dt/m))
///   ease       tolerance scaling of a node: 1 + a T_i / tolerance, the factor by which its residual may be larger
///
/// Symbols: r residual [N], l residual_at_little_tension (0: r instead of the clamp), a residual_of_tension, t_r
/// residual_from_step [s]; T largest tension of the rod, T_i of the edges of node i [N].
///
/// What is left unbalanced shakes the rod, the more often the shorter the steps: it would keep them short. A node's own
/// edges count: in a locked knot they bear kN, while next to it are tails that a very small force moves.
/// While a shape settles, its drag holds what is left unbalanced back by 1 + c dt/m, c the drag and m the mass per
/// length [kg/m], and s is as much larger.
class ResidualRule {
 public:
  explicit ResidualRule(const StepSettings& settings)
      : residual_(settings.residual),
        from_step_(settings.residual_from_step),
        of_tension_(settings.residual_of_tension),
        at_little_tension_(settings.residual_at_little_tension) {}

  /// `held_back`: c dt/m.
  double tolerance(double tension, double dt, double held_back) const {
    const double short2 = dt * dt * (1.0 + held_back), full2 = from_step_ * from_step_;
    const double share = short2 < full2 ? short2 / full2 : 1.0;
    return std::max(share * loose(tension), kInShortSteps * residual_);
  }
  double ease(double tension_at_node, double tolerance) const {
    return 1.0 + of_tension_ * tension_at_node / tolerance;
  }

 private:
  static constexpr double kInShortSteps = 1e-3, kAtLittleTension = 1e-2;  // of r, at least

  double loose(double tension) const {
    if (at_little_tension_ <= 0.0) return residual_;
    return std::clamp(at_little_tension_ * tension, kAtLittleTension * residual_, residual_);
  }

  double residual_, from_step_, of_tension_, at_little_tension_;
};

}  // namespace knot_utm
