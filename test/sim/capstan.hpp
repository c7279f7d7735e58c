#pragma once

#include <cmath>

#include "sim/scenes.hpp"

namespace knot_utm {

/// Capstan with a rod that resists bending: the larger tension over the smaller one, both far from the roller.
///
///     T2 (cos a2 - mu sin a2) = T1 (cos a1 + mu sin a1) exp(mu (phi - a1 - a2)),  cos a_i = 1 - B/(2 T_i rho^2)
///
/// with the angles a_i by which the rod leaves the roller early; rho is the radius of its centreline there.
inline double elastic_capstan(double t1, double mu, double phi) {
  auto angle = [](double t) { return std::acos(1.0 - 0.5 / t); };
  const double a1 = angle(t1);
  double ratio = std::exp(mu * phi);
  for (int i = 0; i < 100; ++i) {
    const double a2 = angle(ratio * t1);
    ratio = (std::cos(a1) + mu * std::sin(a1)) * std::exp(mu * (phi - a1 - a2)) / (std::cos(a2) - mu * std::sin(a2));
  }
  return ratio;
}

/// The same where friction acts at the surface, of curvature 1/rho throughout: T grows as exp(x phi) with eta = h/rho.
/// Friction leaves the shear force Q = -mu p h, so that, with f = mu (1 - eta), T' = f p and p = T/rho + Q', and x
/// solves mu eta x^2 + x = f. Resistance to rolling has no part in it: the sections turn about the shaft's axis, across
/// the line of contact.
inline double surface_exponent(double mu, double eta) {
  const double f = mu * (1.0 - eta);
  return 2.0 * f / (1.0 + std::sqrt(1.0 + 4.0 * mu * eta * f));
}

/// A rod of bending stiffness 1 around a shaft of a radius near 1, pulled at T1 or more.
inline StepSettings capstan_settings(const Material& material, double t1, double tolerance, double residual) {
  StepSettings settings = closed_form_settings(material);
  settings.pressure_law = NormalLaw{2e3 * t1, tolerance};
  settings.residual = residual * t1;
  settings.residual_of_tension = 0.0;
  settings.newton_cap = 0.05;
  settings.motion_limit = 0.5;
  settings.overlap_limit = 0.05;
  return settings;
}

}  // namespace knot_utm
