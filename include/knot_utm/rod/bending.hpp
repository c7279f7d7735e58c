#pragma once

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/bending_law.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/stencil.hpp"

namespace knot_utm {

struct RodState;

/// Bending at one inner node from material curvatures, with natural curvature.
///
///   E = k_b/(2 lbar) [(kappa_1 - kappabar_1)^2 + (kappa_2 - kappabar_2)^2]
///   kappa_1 =  s (v . m1_e - u . m1_f)
///   kappa_2 =  s (v . m2_e - u . m2_f)
///
///   e, f        edge vectors before and behind the node  [m];  u, v their unit tangents, c = u . v, w = (1 - c)/2
///   s(c)        sqrt(G/(1 - w))/4 with G of turning_angle.hpp; phi/(2 sin phi), phi being the turning angle [-]
///   m1, m2      material directors of the two edges (frames.hpp)
///   kappa_k     integrated material curvatures, the turning angle in a plane bend [-]: kappa_1 is positive where the
///               rod turns towards +m1, kappa_2 where it turns towards +m2
///   lbar        Voronoi length [m];  k_b bending stiffness [N m^2]
///
/// With the vector kb of length phi along u x v, kappa_1 = 1/2 kb . (m2_e + m2_f), kappa_2 = -1/2 kb . (m1_e + m1_f).
///
/// Both curvatures have one form, kappa = s N, N = v . p - u . q with p, q the k-th directors of e, f. Directors follow
/// their edge by parallel transport, p(u + eps) = p - (p . eps)(u + eps/2) + O(eps^3), so
///
///   N_u = -(c p + q)                N_v = p + c q
///   N_uu = -1/2 (p v^T + v p^T)     N_vv = 1/2 (q u^T + u q^T)     N_uv = v q^T - p u^T
///   kappa_a = s N_a + s' N c_a,   c_u = v, c_v = u, c_uv = 1
///   kappa_ab = s N_ab + s' (N_a c_b^T + c_a N_b^T + N c_ab) + s'' N c_a c_b^T
///
/// and the derivatives of u = e/|e| add projections and the curvature of the unit sphere. Derivatives in theta have p'
/// = dp/dtheta (m1' = m2, m2' = -m1) in place of p: kappa_theta_e = s v . p', kappa_theta_f = -s u . q'. The Hessian is
/// that of E as a function of positions and angles, the reference frame being transported from the present one; it is
/// symmetric.
///
/// Where the two edges are twisted by m against each other, the averaged directors see the curvature times cos(m/2):
/// an error of second order in the edge length that couples bending and twisting. A rod that stays straight at rest
/// avoids it, because it bends by isotropic_bending.hpp, with or without twist.
/// Source: Bergou et al. 2010, section 4.2; Jawed, Novelia, O'Reilly 2018, chapters 4 and 7, with the turning angle
/// in place of 2 tan(phi/2); derivatives our own.
struct BendingInput {
  double k_b = 0.0;                                             ///< [N m^2]
  double voronoi_length = 0.0;                                  ///< lbar [m]
  Eigen::Vector2d natural_curvature = Eigen::Vector2d::Zero();  ///< kappabar_1, kappabar_2 [-]
};

/// kappa_1, kappa_2 [-] at the node between edges e and f.
Eigen::Vector2d material_curvature(const Vec3& e, const Vec3& f, const Directors& on_e, const Directors& on_f);

/// The same and their derivatives in the node's unknowns, for any bending law.
struct CurvatureLocal {
  Eigen::Vector2d value;  ///< [-]
  StencilVector slope[2];
  StencilMatrix second[2];
};
CurvatureLocal curvature_local(const Vec3& e, const Vec3& f, const Directors& on_e, const Directors& on_f);

/// A law's response at one node as energy, gradient and Hessian in the unknowns of the node's stencil.
StencilLocal on_nodes(const BendingResponse& law, const CurvatureLocal& bend);

/// Energy, gradient and Hessian of the elastic law (elastic_bending.hpp) at one node.
double bending_energy(const BendingInput& input, const Vec3& e, const Vec3& f, const Directors& on_e,
                      const Directors& on_f);

StencilLocal bending(const BendingInput& input, const Vec3& e, const Vec3& f, const Directors& on_e,
                     const Directors& on_f);

}  // namespace knot_utm
