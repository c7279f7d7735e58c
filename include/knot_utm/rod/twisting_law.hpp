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

/// A twisting law gives the twisting moment of an inner node as a function of its twist. This one is linear,
///
///     E = k_t/(2 lbar) (m - mbar)^2.
///
/// Energy, moment and tangent are taken from `TwistingLaw` everywhere, for one node or for four side by side. It is the
/// only law there is, so it has no key in a method and nothing to save; a second one would make a variant of it, as
/// StretchingLaws is. The energy of a node without stiffness is undefined and must not be read.
struct LinearTwisting {
  template <typename Real>
  TwistingResponse<Real> respond(const TwistedNode<Real>& node) const {
    const Real moment = node.stiffness * node.twist;
    return {0.5 * moment * moment / node.stiffness, moment, node.stiffness};
  }
};

using TwistingLaw = LinearTwisting;

}  // namespace knot_utm
