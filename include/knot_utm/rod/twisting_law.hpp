#pragma once

namespace knot_utm {

/// What a twisting law is told of one inner node, or of four. `Real`: double, or Lanes.
template <typename Real>
struct TwistedNode {
  Real stiffness;  ///< k_t/lbar, 0 at an edge that has parted [N m]
  Real twist;      ///< m - mbar [rad]
};

template <typename Real>
struct TwistingResponse {
  Real energy;   ///< E [J]
  Real moment;   ///< dE/dm [N m]
  Real tangent;  ///< d2E/dm2 [N m]
};

/// A twisting law says of every inner node which moment its twist needs. This one is linear,
///
///     E = k_t/(2 lbar) (m - mbar)^2.
///
/// All that twists takes energy, moment and tangent from `TwistingLaw`, once for four nodes side by side. It is the
/// only law there is, so it has no key in a method and nothing to save; a second one would make a variant of it, as
/// StretchingLaws is. No energy is read of a node without stiffness.
struct LinearTwisting {
  template <typename Real>
  TwistingResponse<Real> respond(const TwistedNode<Real>& node) const {
    const Real moment = node.stiffness * node.twist;
    return {0.5 * moment * moment / node.stiffness, moment, node.stiffness};
  }
};

using TwistingLaw = LinearTwisting;

}  // namespace knot_utm
