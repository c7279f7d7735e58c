#pragma once

#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// The 11 unknowns that an inner node's bending or twisting energy depends on, in this order:
///   x_{i-1} (0-2), theta_{i-1} (3), x_i (4-6), theta_i (7), x_{i+1} (8-10).
/// With the unknowns of a rod numbered x_0, theta_0, x_1, theta_1, ..., x_{N-1}, the stencil of inner node i is the
/// contiguous run that starts at 4 (i - 1). Positions in m, angles in rad.
inline constexpr Eigen::Index kStencilSize = 11;
using StencilVector = Eigen::Matrix<double, kStencilSize, 1>;
using StencilMatrix = Eigen::Matrix<double, kStencilSize, kStencilSize>;

struct StencilLocal {
  double energy = 0.0;                             ///< [J]
  StencilVector gradient = StencilVector::Zero();  ///< [N], and [N m] for the angles
  StencilMatrix hessian = StencilMatrix::Zero();   ///< [N/m], [N] and [N m]
};

/// First and second derivatives of a scalar s(e, f, theta_e, theta_f), with e = x_i - x_{i-1}, f = x_{i+1} - x_i.
struct EdgePairGradient {
  Vec3 e = Vec3::Zero();
  Vec3 f = Vec3::Zero();
  double theta_e = 0.0;
  double theta_f = 0.0;
};

struct EdgePairHessian {
  Mat3 ee = Mat3::Zero();
  Mat3 ef = Mat3::Zero();  ///< rows e, columns f
  Mat3 ff = Mat3::Zero();
  Vec3 e_theta_e = Vec3::Zero();
  Vec3 e_theta_f = Vec3::Zero();
  Vec3 f_theta_e = Vec3::Zero();
  Vec3 f_theta_f = Vec3::Zero();
  double theta_e_theta_e = 0.0;
  double theta_f_theta_f = 0.0;  // theta_e and theta_f never meet in one curvature or twist
};

/// From edge vectors to nodes: ds/dx_{i-1} = -s_e, ds/dx_i = s_e - s_f, ds/dx_{i+1} = s_f.
inline StencilVector on_nodes(const EdgePairGradient& s) {
  StencilVector g;
  g.segment<3>(0) = -s.e;
  g[3] = s.theta_e;
  g.segment<3>(4) = s.e - s.f;
  g[7] = s.theta_f;
  g.segment<3>(8) = s.f;
  return g;
}

inline StencilMatrix on_nodes(const EdgePairHessian& s) {
  StencilMatrix h;
  h.block<3, 3>(0, 0) = s.ee;
  h.block<3, 3>(0, 4) = s.ef - s.ee;
  h.block<3, 3>(0, 8) = -s.ef;
  h.block<3, 3>(4, 4) = s.ee - s.ef - s.ef.transpose() + s.ff;
  h.block<3, 3>(4, 8) = s.ef - s.ff;
  h.block<3, 3>(8, 8) = s.ff;
  h.block<3, 3>(4, 0) = h.block<3, 3>(0, 4).transpose();
  h.block<3, 3>(8, 0) = h.block<3, 3>(0, 8).transpose();
  h.block<3, 3>(8, 4) = h.block<3, 3>(4, 8).transpose();

  h.block<3, 1>(0, 3) = -s.e_theta_e;
  h.block<3, 1>(4, 3) = s.e_theta_e - s.f_theta_e;
  h.block<3, 1>(8, 3) = s.f_theta_e;
  h.block<3, 1>(0, 7) = -s.e_theta_f;
  h.block<3, 1>(4, 7) = s.e_theta_f - s.f_theta_f;
  h.block<3, 1>(8, 7) = s.f_theta_f;
  for (const Eigen::Index angle : {3, 7}) {
    for (const Eigen::Index node : {0, 4, 8}) h.block<1, 3>(angle, node) = h.block<3, 1>(node, angle).transpose();
  }
  h(3, 3) = s.theta_e_theta_e;
  h(7, 7) = s.theta_f_theta_f;
  h(3, 7) = 0.0;
  h(7, 3) = 0.0;
  return h;
}

}  // namespace knot_utm
