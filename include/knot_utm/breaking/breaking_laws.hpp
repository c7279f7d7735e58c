#pragma once

#include <array>
#include <variant>

#include "knot_utm/numeric/law_registry.hpp"
#include "knot_utm/rod/stretching_laws.hpp"
#include "knot_utm/specimen/material.hpp"

namespace knot_utm {

enum class BreakLimit { kForce, kStrain };  ///< breaking force, strain of the outermost fibre

/// Input of a breaking law for one edge. The law gives `limited`, the quantity that parts the rod, and `fraction`, that
/// quantity over its value at which a straight rod parts.
struct LoadedEdge {
  double tension;  ///< T [N]
  double strain;   ///< lambda - 1 [-]
  double bend;     ///< h kappa, the strain by which bending alone stretches the outermost fibre [-]
  double pressed;  ///< h p, with p the force per length by which contacts press it flat; 0 unless the law `crushes` [N]
};

/// A rod parts where its tension T reaches the breaking force F_b, the tension at which it parts straight [N]:
///
///   fraction = T/F_b
///
/// In a knot the tension is never larger than the load, so this law cannot predict how much a knot weakens a rope.
struct TensionBreaking {
  static constexpr const char* kName = "tension";
  static constexpr NoKeys kKeys{};
  static constexpr bool kStudied = true;
  static constexpr bool kBends = false;  ///< whether the bend of an edge counts
  static constexpr BreakLimit kLimit = BreakLimit::kForce;

  double breaking_force = 0.0;  ///< F_b [N]

  static TensionBreaking of(const Material& material) { return {*material.breaking_force}; }

  double limited(const LoadedEdge& edge) const { return edge.tension; }
  double fraction(const LoadedEdge& edge) const { return edge.tension / breaking_force; }
  bool crushes() const { return false; }
};

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
/// That the three terms add up, and what p is in a knot, are assumptions of ours. Friction heats a section and fibres
/// yield; the law leaves both out, so b and c that are fitted contain them (doc/model.md, section 8, "The rod parts").
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

/// All breaking laws there are, in the order in which messages name them; the first is the default.
using BreakingLaws = std::variant<TensionBreaking, FibreBreaking>;

using BreakingRegistry = LawRegistry<BreakingLaws>;

/// The law of a material, which must have a breaking force.
inline BreakingLaws breaking_law_of(const Material& material) {
  return BreakingRegistry::of(material.breaking.law, material);
}

/// Whether a rope of the specimen has a breaking force.
inline bool can_part(const Material& material) { return weakest(material).has_value(); }

/// Whether the bend of a rope of this material helps to part it, so that a knot costs strength.
inline bool parts_by_bending(const Material& material) {
  return material.breaking_force && std::visit([](const auto& law) { return law.kBends; }, breaking_law_of(material));
}
/// The same of every rope. Otherwise the strength of a knot may just be that of a straight rope, which was given.
inline bool all_part_by_bending(const Material& material) {
  return parts_by_bending(material) && (!material.other || parts_by_bending(*material.other));
}

}  // namespace knot_utm
