#pragma once

#include <array>

#include "knot_utm/breaking/breaking_law.hpp"
#include "knot_utm/numeric/law_registry.hpp"
#include "knot_utm/rod/stretching_laws.hpp"
#include "knot_utm/specimen/material.hpp"

namespace knot_utm {

/// A rod parts where the strain of its outermost fibre reaches the one at which a straight rod parts:
///
///   eps = lambda - 1 + b h kappa + c eps_b h p/F_b,     fraction = eps/eps_b
///
///   eps_b   the strain of a straight rod under F_b [-]
///   lambda  stretch of the edge [-]                h  radius [m]
///   kappa   curvature at its more bent end [1/m]   F_b  breaking force of a straight rod [N]
///   b       `bending_share`: how much of its bend a fibre bears; 1 in a solid rod, less in a bundle whose fibres slide
///           on each other as it bends, 0 where they slide freely [-]
///   p       force per length by which contacts press the section flat (RopeStrengths) [N/m]
///   c       `crushing_share`: how much of its strength a fibre loses where it is pressed flat by F_b/h [-]
///
/// With the linear law of stretching, lambda - 1 = T/k_s and eps_b = F_b/k_s, so that
///
///   fraction = T/F_b + b h kappa/eps_b + c h p/F_b
///
/// A rope around a smooth post, R from its axis, has p = T/R and parts at T = F_b (1 - b h/(R eps_b))/(1 + c h/R). Left
/// out: that friction heats a section and that fibres yield; both have to be in b and c where these are fitted.
/// Sources: Pieranski et al. 2001, who see knotted strings part where tension and curvature are large at once; Rigging
/// Institute 2011, whose wire ropes over pins of 1 to 20 diameters keep 0.50 to 0.92, as 1/(1 + c h/R) does within 0.03
/// with c = 1.8. That the three add up, and what p is in a knot, is our own.
struct FibreBreaking {
  static constexpr const char* kName = "tension_and_bending";
  static constexpr LawKey kBendingShare{
      "bending_share", 0.0, 1.0, "-", LawDefault::kNone, LawKey::kNoValue, "share of its bend that a fibre bears"};
  static constexpr LawKey kCrushingShare{
      "crushing_share", 0.0, 100.0, "-", LawDefault::kPlain, 0.0, "strength lost by being pressed flat; by F_b/h"};
  static constexpr std::array kKeys{kBendingShare, kCrushingShare};
  static constexpr bool kStudied = false;
  static constexpr bool kBends = true;
  static constexpr BreakLimit kLimit = BreakLimit::kStrain;

  double breaking_strain = 0.0;  ///< eps_b [-]
  double share = 0.0;            ///< b [-]
  double crushing = 0.0;         ///< c eps_b/F_b [1/N]

  static FibreBreaking of(const Material& material) {
    const auto& keys = material.breaking;
    const double strain = strain_under(material, *material.breaking_force);
    return {strain, keys.number(kBendingShare), keys.number(kCrushingShare) * strain / *material.breaking_force};
  }

  double limited(const LoadedEdge& edge) const { return edge.strain + share * edge.bend + crushing * edge.pressed; }
  double fraction(const LoadedEdge& edge) const { return limited(edge) / breaking_strain; }
  bool crushes() const { return crushing > 0.0; }
};

}  // namespace knot_utm
