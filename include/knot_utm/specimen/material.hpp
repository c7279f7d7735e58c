#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "knot_utm/rod/material.hpp"

namespace knot_utm {

/// Number of a breaking law in its registry (breaking/breaking_laws.hpp).
enum class BreakingLaw : std::size_t {};

/// The `material` section of a method: what the rod is made of, and how it rubs, is tied and parts.
struct Material : RodMaterial {
  std::string name;
  double friction_coefficient = 0.0;        ///< mu [-]
  std::optional<double> friction_couple;    ///< 0 or 1 [-]; unset: default_friction_couple
  double rolling_resistance = 0.0;          ///< mu_r of its contacts (RollingResistance) [-]
  double rolling_hysteresis = 0.0;          ///< alpha of a solid rod's contacts (growth_of_hysteresis) [-]
  std::optional<double> contact_stiffness;  ///< K [N/m^2], of the pressure law; unset: default_contact_stiffness
  std::optional<double> tying_preload;      ///< F_p [N]; unset: default_preload
  std::optional<double> breaking_force;     ///< F_b, tension at which it parts straight [N]; unset: it does not
  LawOptions<BreakingLaw> breaking;         ///< breaking.law and the keys of that law
  std::string load_cell;                    ///< name of the load cell that suits it
  std::string notes;
  std::shared_ptr<const Material> other;  ///< `other_material`, of all ropes but the first; null: they have this one
};

/// Radius of the thickest rope, the unit of a drawing, and of the thinnest one [m].
inline double thickest(const Material& material) {
  return material.other ? std::max(material.radius, material.other->radius) : material.radius;
}
inline double thinnest(const Material& material) {
  return material.other ? std::min(material.radius, material.other->radius) : material.radius;
}

/// Breaking force of the weakest rope [N]; unset: none parts.
inline std::optional<double> weakest(const Material& material) {
  if (!material.other || !material.other->breaking_force) return material.breaking_force;
  const double other = *material.other->breaking_force;
  return std::min(material.breaking_force.value_or(other), other);
}

/// Pre-load F_p of `specimen.preload: auto` [N]: the material's own, else 4 k_b/h^2, with which a knot holds together
/// once its tails are let go, but at most half of the breaking force. Of two materials the larger one of both, but at
/// most half of what the weaker rope bears, and what doubles the length of the softer one.
inline double default_preload(const Material& material) {
  const double holds = 4.0 * material.bending_stiffness / (material.radius * material.radius);
  const double own = material.tying_preload.value_or(
      material.breaking_force ? std::min(holds, 0.5 * *material.breaking_force) : holds);
  if (!material.other) return own;
  const double softer = std::min(material.stretching_stiffness, material.other->stretching_stiffness);
  const double larger = std::min(std::max(own, default_preload(*material.other)), softer);
  return weakest(material) ? std::min(larger, 0.5 * *weakest(material)) : larger;
}

/// Contact stiffness K of `auto` [N/m^2]: the material's own, else 300 k_b/h^4. Strands that are pressed together by
/// the force k_b/h^2 over a length h of rod then overlap by h/300. Soft sections have 0.77 E, E = k_s/(pi h^2).
inline double default_contact_stiffness(const Material& material) {
  const double h2 = material.radius * material.radius;
  const double own = material.is_soft() ? 0.77 * material.stretching_stiffness / (M_PI * h2)
                                        : 300.0 * material.bending_stiffness / (h2 * h2);
  return material.contact_stiffness.value_or(own);
}

/// 1: friction acts at the surface of a strand, a radius off its centreline, with the couple that this makes; 0: on the
/// centreline, as in the source paper. The material's own, else 1 (doc/model.md, section 5).
inline double default_friction_couple(const Material& material) { return material.friction_couple.value_or(1.0); }

}  // namespace knot_utm
