#pragma once

#include "knot_utm/rod/rod.hpp"

namespace knot_utm {

/// Stretching of one edge.
///
///   E = 1/2 k_s l0 (|e|/l0 - 1)^2
///
///   e    edge vector x_{i+1} - x_i                 [m]
///   l0   length of the edge at rest                [m]
///   k_s  stretching stiffness (Young's modulus
///        times area for a solid rod)               [N]
///   T    tension k_s (|e|/l0 - 1), positive pulls  [N]
///   t    unit tangent e/|e|                        [-]
///
///   dE/de     = T t                                (force on x_i is +T t, on x_{i+1} is -T t)
///   d2E/de2   = k_s/l0 t t^T + T/|e| (1 - t t^T)   (indefinite where the edge is compressed)
///
/// An edge of length zero has no tangent; the caller keeps |e| > 0.
/// Source: Bergou, Audoly, Vouga, Wardetzky, Grinspun 2010, section 4.2.
struct StretchingGradient {
  double energy;  ///< [J]
  Vec3 gradient;  ///< dE/de [N]: +gradient on x_{i+1}, -gradient on x_i
};

/// As StretchingGradient, and the Hessian: +hessian on (i,i) and (i+1,i+1), -hessian on (i,i+1).
struct StretchingLocal {
  double energy;  ///< [J]
  Vec3 gradient;  ///< dE/de [N]
  Mat3 hessian;   ///< d2E/de2 [N/m]
};

/// Tension T [N] of an edge; positive pulls its ends together.
inline double stretching_tension(double k_s, double l0, const Vec3& edge) { return k_s * (edge.norm() / l0 - 1.0); }

inline StretchingGradient stretching_gradient(double k_s, double l0, const Vec3& edge) {
  const double length = edge.norm();
  const double strain = length / l0 - 1.0;
  return {0.5 * k_s * l0 * strain * strain, (k_s * strain / length) * edge};
}

inline StretchingLocal stretching(double k_s, double l0, const Vec3& edge) {
  const double length = edge.norm();
  const double strain = length / l0 - 1.0;
  const Vec3 tangent = edge / length;
  const double tension = k_s * strain;
  const double across = tension / length;
  StretchingLocal local;
  local.energy = 0.5 * tension * strain * l0;
  local.gradient = tension * tangent;
  local.hessian.noalias() = (k_s / l0 - across) * tangent * tangent.transpose();
  local.hessian.diagonal().array() += across;
  return local;
}

}  // namespace knot_utm
