#pragma once

#include <cstddef>
#include <optional>

#include "knot_utm/numeric/law_registry.hpp"

namespace knot_utm {

/// Number of a stretching law in its registry (stretching_laws.hpp).
enum class StretchingLaw : std::size_t {};
/// Number of a bending law in its registry (bending_laws.hpp).
enum class BendingLaw : std::size_t {};
/// Round ones keep their shape and their radius. Soft ones are flattened where strands press on each other, and grow
/// thin as the rod is stretched (contact/soft_section.hpp).
enum class CrossSection { kRound, kSoft };

/// Deepest overlap of a contact of soft sections that a step may begin or end with [fraction of radius].
inline constexpr double kDeepestSoft = 1.2;

/// What a rod of circular cross-section is made of. The three stiffnesses are independent: a braided rope
/// bends 10^3 to 10^4 times softer than a solid rod of the same stretching stiffness.
struct RodMaterial {
  double radius = 0.0;                          ///< h [m]
  double density = 0.0;                         ///< rho [kg/m^3]
  double stretching_stiffness = 0.0;            ///< k_s [N]
  double bending_stiffness = 0.0;               ///< k_b [N m^2]
  double twisting_stiffness = 0.0;              ///< k_t [N m^2]
  CrossSection section = CrossSection::kRound;  ///< what contacts make of it
  LawOptions<StretchingLaw> stretching;         ///< stretching_law and the keys of that law
  LawOptions<BendingLaw> bending;               ///< bending_law and the keys of that law
  std::optional<double> yield_strain;           ///< eps_y of its outermost fibre (plastic_bending.hpp) [-]; unset: none

  bool is_soft() const { return section == CrossSection::kSoft; }
  /// Half of the least distance of two strands' centrelines [m]: h, or what soft sections leave of it.
  double core_radius() const { return is_soft() ? radius * (1.0 - 0.5 * kDeepestSoft) : radius; }

  /// What a time step takes from it: radius, density and stiffnesses. Its laws have been made (RodLaws).
};

/// Whether a rod bends like a solid one, whose k_s h^2/k_b is 4. That of ropes is in the hundreds or more.
inline bool is_solid(const RodMaterial& material) {
  constexpr double kStiffest = 10.0;  // k_s h^2/k_b of what still counts as solid
  const double h = material.radius;
  return material.stretching_stiffness * h * h < kStiffest * material.bending_stiffness;
}

}  // namespace knot_utm
