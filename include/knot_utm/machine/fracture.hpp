#pragma once

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/specimen/material.hpp"

namespace knot_utm {

enum class BreakLimit { kForce, kStrain };  ///< breaking force, breaking strain

/// How near a rod is to parting, and at which edge. It parts there when the fraction reaches 1.
///
/// Symbols: T tension [N], F_b breaking force [N], lambda stretch of the edge [-], h radius [m], kappa curvature at its
/// more bent end, the angle it turns by over lbar [1/m], eps_b breaking strain [-]. The exposure of edge j is
///
///   fraction_j = max(T_j/F_b, (lambda_j - 1 + h kappa_j)/eps_b),
///
/// with those of the two terms whose limit the material gives: tension, and strain of the outermost fibre. The strain
/// of bending counts in a solid rod. In a rope fibres slip past each other as it bends, so it has a breaking force
/// only.
struct Exposure {
  double fraction = 0.0;  ///< largest of all edges [-]
  int edge = -1;          ///< that edge; -1: no fraction is positive, because no edge is under tension or bent
  BreakLimit limit = BreakLimit::kForce;  ///< the limit that is nearest
  double value = 0.0;  ///< the quantity that is limited: tension [N] or strain of the outermost fibre [-]
};

bool can_part(const Material& material);  ///< it has a limit

Exposure most_exposed(const Material& material, const RodProperties& rod, const Points& position);

/// Time that a wave of tension takes along a length [m] of the rod: length sqrt(rho pi h^2/k_s) [s].
double transit_time(const RodMaterial& material, double length);

/// Whether another strand lies against an edge, nearer than 2.2 h to it and further than 5 h along the rod.
bool lies_in_knot(const RodProperties& rod, const Points& position, int edge);

}  // namespace knot_utm
