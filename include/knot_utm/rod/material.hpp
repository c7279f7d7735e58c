#pragma once

#include <optional>
#include <string>

namespace knot_utm {

/// What a rod of circular cross-section is made of. The three stiffnesses are independent: a braided rope
/// bends 10^3 to 10^4 times softer than a solid rod of the same stretching stiffness.
struct Material {
  std::string name;
  double radius = 0.0;                      ///< h [m]
  double density = 0.0;                     ///< rho [kg/m^3]
  double stretching_stiffness = 0.0;        ///< k_s [N]
  double bending_stiffness = 0.0;           ///< k_b [N m^2]
  double twisting_stiffness = 0.0;          ///< k_t [N m^2]
  double friction_coefficient = 0.0;        ///< mu [-]
  std::optional<double> contact_stiffness;  ///< K [N/m^2], line force per penetration; unset: from k_s, k_b, h
  std::optional<double> tying_preload;      ///< F_p [N] that `specimen.preload: auto` stands for
  std::optional<double> breaking_force;     ///< [N]
  std::string load_cell;                    ///< name of the load cell that suits it
  std::string notes;
};

}  // namespace knot_utm
