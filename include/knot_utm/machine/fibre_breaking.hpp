#pragma once

#include <array>
#include <limits>

#include "knot_utm/machine/breaking_law.hpp"
#include "knot_utm/machine/weakest_link.hpp"
#include "knot_utm/numeric/law_keys.hpp"

namespace knot_utm {

struct Material;

/// A rod parts where the strain of its outermost fibre reaches the one at which a straight rod parts:
///
///   eps = lambda - 1 + b h kappa,     eps_b: the strain of a straight rod under F_b,     fraction = eps/eps_b
///
///   lambda  stretch of the edge [-]                h  radius [m]
///   kappa   curvature at its more bent end [1/m]   F_b  breaking force of a straight rod [N]
///   b       `bending_share`: how much of its bend a fibre bears; 1 in a solid rod, less in a bundle whose fibres slide
///           on each other as it bends, 0 where they slide freely [-]
///
/// With the linear law of stretching, lambda - 1 = T/k_s and eps_b = F_b/k_s. Left out: that contacts crush a section,
/// that friction heats it and that fibres yield; all three have to be in b where it is fitted. Source: Pieranski et al.
/// 2001, who see knotted strings part where tension and curvature are large at once; the law in b is our own.
struct FibreBreaking {
  static constexpr const char* kName = "tension_and_bending";
  static constexpr LawKey kBendingShare{
      "bending_share", 0.0, 1.0, "-", LawDefault::kNone, std::numeric_limits<double>::quiet_NaN()};
  static constexpr LawKey kWeibullModulus{"weibull_modulus",
                                          1.0,
                                          std::numeric_limits<double>::infinity(),
                                          "-",
                                          LawDefault::kPlain,
                                          std::numeric_limits<double>::infinity()};
  static constexpr LawKey kTestedLength{"tested_length", 1e-4, 100.0, "m", LawDefault::kPlain, 0.25};
  static constexpr LawKey kWeakerShare{"weaker_share", 1e-6, 1.0 - 1e-6, "-", LawDefault::kPlain, 0.5};
  static constexpr std::array kKeys{kBendingShare, kWeibullModulus, kTestedLength, kWeakerShare};
  static constexpr bool kStudied = false;
  static constexpr bool kBends = true;
  static constexpr BreakLimit kLimit = BreakLimit::kStrain;

  double breaking_strain = 0.0;  ///< eps_b [-]
  double share = 0.0;            ///< b [-]
  WeakestLink link;

  static FibreBreaking of(const Material& material);

  double limited(const LoadedEdge& edge) const { return edge.strain + share * edge.bend; }
  double fraction(const LoadedEdge& edge) const { return limited(edge) / breaking_strain; }
};

}  // namespace knot_utm
