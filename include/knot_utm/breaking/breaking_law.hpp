#pragma once

namespace knot_utm {

enum class BreakLimit { kForce, kStrain };  ///< breaking force, strain of the outermost fibre

/// What a breaking law knows of an edge. It answers with `limited`, the quantity that parts the rod, and `fraction`,
/// that quantity over what a straight rod parts at.
struct LoadedEdge {
  double tension;  ///< T [N]
  double strain;   ///< lambda - 1 [-]
  double bend;     ///< h kappa, the strain by which bending alone stretches the outermost fibre [-]
  double pressed;  ///< h p, p the force per length that contacts press it flat with; 0 where its law does not ask [N]
};

}  // namespace knot_utm
