#pragma once

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/isotropic_bending.hpp"

namespace knot_utm {

/// The bending of isotropic_bending.hpp at one node, with the Hessian in the edge vectors, from the formulas as they
/// stand there: the slow oracle of CentrelineTerms, which has the same for four nodes at once. On the nodes, with H_fe
/// = H_ef^T:
///   (i-1,i-1)  H_ee          (i-1,i)  H_ef - H_ee               (i-1,i+1)  -H_ef
///   (i,i)      H_ee - H_ef - H_fe + H_ff   (i,i+1)  H_ef - H_ff     (i+1,i+1)   H_ff
struct IsotropicBendingLocal {
  double energy;    ///< [J]
  Vec3 gradient_e;  ///< dE/de [N]
  Vec3 gradient_f;  ///< dE/df [N]
  Mat3 hessian_ee;  ///< d2E/de2 [N/m]
  Mat3 hessian_ef;  ///< d2E/de df [N/m], rows e, columns f
  Mat3 hessian_ff;  ///< d2E/df2 [N/m]
};

inline IsotropicBendingLocal isotropic_bending(double k_b, double voronoi_length, const Vec3& e, const Vec3& f) {
  const double inverse_e = 1.0 / e.norm();
  const double inverse_f = 1.0 / f.norm();
  const Vec3 t_e = inverse_e * e;
  const Vec3 t_f = inverse_f * f;
  const double c = t_e.dot(t_f);
  const double stiffness = k_b / voronoi_length;
  const BendingSlopes<double> slopes = BendingSlopes<double>::at(c);
  const double slope = stiffness * slopes.first, curve = stiffness * slopes.second;
  const Vec3 c_e = inverse_e * (t_f - c * t_e);
  const Vec3 c_f = inverse_f * (t_e - c * t_f);

  IsotropicBendingLocal local;
  local.energy = 0.5 * stiffness * bending_angle_squared((t_f - t_e).squaredNorm());
  local.gradient_e = slope * c_e;
  local.gradient_f = slope * c_f;

  // The rank-one terms of each block are gathered by their right factor: two multiples of a vector make a column.
  const double diagonal_e = slope * c * inverse_e * inverse_e;
  const double diagonal_f = slope * c * inverse_f * inverse_f;
  const double diagonal_ef = slope * inverse_e * inverse_f;
  const Vec3 on_c_e = curve * c_e - (slope * inverse_e) * t_e;
  const Vec3 on_c_f = curve * c_f - (slope * inverse_f) * t_f;
  const Vec3 on_t_e = diagonal_e * t_e - (slope * inverse_e) * c_e;
  const Vec3 on_t_f = diagonal_f * t_f - (slope * inverse_f) * c_f;
  for (Eigen::Index k = 0; k < 3; ++k) {
    local.hessian_ee.col(k) = c_e[k] * on_c_e + t_e[k] * on_t_e;
    local.hessian_ff.col(k) = c_f[k] * on_c_f + t_f[k] * on_t_f;
    local.hessian_ef.col(k) = c_f[k] * on_c_e - (diagonal_ef * t_f[k]) * t_f;
  }
  local.hessian_ee.diagonal().array() -= diagonal_e;
  local.hessian_ff.diagonal().array() -= diagonal_f;
  local.hessian_ef.diagonal().array() += diagonal_ef;
  return local;
}

}  // namespace knot_utm
