#pragma once

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/turning_angle.hpp"

namespace knot_utm {

/// Bending at one inner node of a rod that is isotropic (one bending stiffness for every direction), straight at
/// rest and free of twist: the energy then depends on the centreline alone, and the rod needs no frame.
///
///   E = k_b/(2 lbar) phi^2 = k_b/(2 lbar) g(w),   w = (1 - c)/2
///
///   e, f      edge vectors x_i - x_{i-1} and x_{i+1} - x_i   [m]
///   t_e, t_f  their unit tangents                            [-]
///   c         t_e . t_f, cosine of the turning angle phi     [-]
///   g = w G   phi^2, but without bound as the rod folds back on itself (turning_angle.hpp)  [-]
///   lbar      Voronoi length of node i                       [m]
///   k_b       bending stiffness                              [N m^2]
///
/// With W(c) = E:  W' = -k_b/(4 lbar) (G + w G'),  W'' = k_b/(8 lbar) (2 G' + w G''),
///
///   c_e  = (t_f - c t_e)/|e|,   c_f = (t_e - c t_f)/|f|
///   c_ee = -(c_e t_e^T + t_e c_e^T)/|e| - c (1 - t_e t_e^T)/|e|^2,   c_ff alike
///   c_ef = ((1 - t_f t_f^T)/|f| - t_e c_f^T)/|e|
///
///   dE/da = W' c_a,   d2E/da db = W'' c_a c_b^T + W' c_ab   for a, b in {e, f}
///
/// On the nodes (i-1, i, i+1) the gradient is (-g_e, g_e - g_f, g_f), the force its negative.
/// Source: Bergou, Wardetzky, Robinson, Audoly, Grinspun 2008, section 4.2, with the turning angle in place of their
/// 2 tan(phi/2).
struct IsotropicBendingGradient {
  double energy;    ///< [J]
  Vec3 gradient_e;  ///< dE/de [N]
  Vec3 gradient_f;  ///< dE/df [N]
};

/// W' and W'' divided by k_b/lbar [-].
template <typename Real>
struct BendingSlopes {
  Real first, second;

  static BendingSlopes at(const Real& c) {
    const Real w = 0.5 - 0.5 * c;
    const SquaredAngleOverW<Real> over = squared_angle_over(w);
    return {-0.25 * (over.value + w * over.first), 0.125 * (2.0 * over.first + w * over.second)};
  }
};

/// phi^2 of the energy, from |t_f - t_e|^2 and not from c, because 1 - c loses its digits where the rod is nearly
/// straight.
inline double bending_angle_squared(double tangents_apart_squared) {
  const double w = 0.25 * tangents_apart_squared;
  return w * squared_angle_over(w).value;
}

inline IsotropicBendingGradient isotropic_bending_gradient(double k_b, double voronoi_length, const Vec3& e,
                                                           const Vec3& f) {
  const double inverse_e = 1.0 / e.norm();
  const double inverse_f = 1.0 / f.norm();
  const Vec3 t_e = inverse_e * e;
  const Vec3 t_f = inverse_f * f;
  const double c = t_e.dot(t_f);
  const double stiffness = k_b / voronoi_length;
  const double slope = stiffness * BendingSlopes<double>::at(c).first;
  return {0.5 * stiffness * bending_angle_squared((t_f - t_e).squaredNorm()), (slope * inverse_e) * (t_f - c * t_e),
          (slope * inverse_f) * (t_e - c * t_f)};
}

}  // namespace knot_utm
