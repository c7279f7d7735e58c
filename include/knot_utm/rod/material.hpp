#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/law_keys.hpp"

namespace knot_utm {

/// Number of a stretching law in its registry (stretching_laws.hpp).
enum class StretchingLaw : std::size_t {};
/// Number of a bending law in its registry (bending_laws.hpp).
enum class BendingLaw : std::size_t {};
/// Number of a twisting law in its registry (twisting_laws.hpp).
enum class TwistingLaw : std::size_t {};
/// Number of a pressure law in its registry (contact/pressure_laws.hpp).
enum class PressureLaw : std::size_t {};

/// What a rod of circular cross-section is made of. The three stiffnesses are independent: a braided rope
/// bends 10^3 to 10^4 times softer than a solid rod of the same stretching stiffness.
struct Material {
  std::string name;
  double radius = 0.0;                    ///< h [m]
  double density = 0.0;                   ///< rho [kg/m^3]
  double stretching_stiffness = 0.0;      ///< k_s [N]
  double bending_stiffness = 0.0;         ///< k_b [N m^2]
  double twisting_stiffness = 0.0;        ///< k_t [N m^2]
  double friction_coefficient = 0.0;      ///< mu [-]
  std::optional<double> friction_couple;  ///< eta [-]; unset: default_friction_couple
  LawOptions<StretchingLaw> stretching;   ///< stretching_law and the keys of that law; so of the others
  LawOptions<BendingLaw> bending;
  LawOptions<TwistingLaw> twisting;
  LawOptions<PressureLaw> pressure;
  double bending_set = 0.0;                 ///< fraction of the bend in its tied knots that the rod keeps at rest [-]
  std::optional<double> contact_stiffness;  ///< K [N/m^2], of the pressure law; unset: default_contact_stiffness
  std::optional<double> tying_preload;      ///< F_p [N]; unset: default_preload
  std::optional<double> breaking_force;     ///< F_b, tension at which it parts [N]; unset: it does not
  std::optional<double> breaking_strain;    ///< eps_b of its outermost fibre (machine/fracture.hpp) [-]; unset: none
  std::optional<double> yield_strain;       ///< eps_y of its outermost fibre (plastic_bending.hpp) [-]; unset: none
  std::string load_cell;                    ///< name of the load cell that suits it
  std::string notes;

  /// What a time step takes from it: radius, density and stiffnesses. Its laws have been made (RodLaws, StepSettings),
  /// and the rest is the machine's.
  void state(Archive& archive);
};

/// Pre-load F_p of `specimen.preload: auto` [N]: the material's own, else 4 k_b/h^2, with which a knot holds together
/// once its tails are let go, but at most half of the breaking force.
inline double default_preload(const Material& material) {
  const double holds = 4.0 * material.bending_stiffness / (material.radius * material.radius);
  return material.tying_preload.value_or(material.breaking_force ? std::min(holds, 0.5 * *material.breaking_force)
                                                                 : holds);
}

/// Contact stiffness K of `auto` [N/m^2]: the material's own, else 300 k_b/h^4. Strands that are pressed together by
/// the force k_b/h^2 over a length h of rod then overlap by h/300.
inline double default_contact_stiffness(const Material& material) {
  const double h2 = material.radius * material.radius;
  return material.contact_stiffness.value_or(300.0 * material.bending_stiffness / (h2 * h2));
}

/// Whether a rod bends like a solid one, whose k_s h^2/k_b is 4. That of ropes is in the hundreds or more.
inline bool is_solid(const Material& material) {
  constexpr double kStiffest = 10.0;  // k_s h^2/k_b of what still counts as solid
  const double h = material.radius;
  return material.stretching_stiffness * h * h < kStiffest * material.bending_stiffness;
}

/// Fraction eta of friction's couple that the section transmits: the material's own, else none. A bundle of fibres that
/// slide past one another carries the couple by a shift of its line of tension. A solid rod transmits all of it, but
/// its knots then roll open, which those of the source paper did not (doc/model.md, section 5).
inline double default_friction_couple(const Material& material) { return material.friction_couple.value_or(0.0); }

}  // namespace knot_utm
