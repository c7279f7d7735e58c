#pragma once

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/stencil.hpp"

namespace knot_utm {

struct RodProperties;
struct RodState;

/// Twisting at one inner node, E = k_t/(2 lbar) m^2.
///
///   m = theta_f - theta_e + m_ref
///
///   theta_e, theta_f  angle of the material against the reference frame on the two edges  [rad]
///   m_ref             reference twist (frames.hpp)        [rad]
///   lbar              Voronoi length [m];  k_t twisting stiffness [N m^2]
///
/// With u, v the unit tangents of e, f, chi = 1 + u . v, b = 2 u x v/chi and t = (u + v)/chi,
///
///   m_e  = b/(2 |e|),   m_f = b/(2 |f|)
///   m_ee = -(b (u + t)^T + (u + t) b^T)/(4 |e|^2),   m_ff = -(b (v + t)^T + (v + t) b^T)/(4 |f|^2)
///   m_ef = ((2/chi) [u]x - b t^T)/(2 |e| |f|)
///
/// The Hessian is that of E as a function of positions and angles, the reference frame being transported from the
/// present one; it is symmetric. Differentiating m_e as it stands gives m_ee plus an antisymmetric part, from the area
/// that the tangent sweeps. Summed over both nodes of an edge, this part is proportional to dE/dtheta, which vanishes
/// in equilibrium where the edge is free to turn.
/// Source: Bergou et al. 2010, section 4.2; Jawed, Novelia, O'Reilly 2018, chapters 4 and 7.
struct TwistingInput {
  double k_t = 0.0;             ///< [N m^2]
  double voronoi_length = 0.0;  ///< lbar [m]
};

double twisting_energy(const TwistingInput& input, double twist);

/// Twist per length m/lbar of each inner node, right-handed about the tangent [rad/m], N-2; empty where the state holds
/// no angles.
Eigen::VectorXd twist_rates(const RodProperties& rod, const RodState& state);

/// `twist` is m [rad]; e and f are the edge vectors before and behind the node [m].
StencilLocal twisting(const TwistingInput& input, const Vec3& e, const Vec3& f, double twist);

}  // namespace knot_utm
