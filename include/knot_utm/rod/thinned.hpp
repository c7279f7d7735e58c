#pragma once

#include "knot_utm/rod/stretching.hpp"

namespace knot_utm {

/// What is left of the bending and twisting stiffness of a solid rod that keeps its volume while it is stretched by
/// lambda (material.section: soft):
///
///     k_b(lambda)/k_b = W''(lambda)/(k_s lambda),    k_t(lambda)/k_t = 1/lambda,
///
/// W being the energy of stretching per length at rest, and bends and twists counted per length at rest, too. For small
/// ones on top of any stretch: the section's second moment falls as lambda^-1 at a given material, and fibres a
/// distance y off the middle are stretched by lambda (1 + y kappa/lambda). The torsion of a neo-Hookean cylinder is
/// exact at any twist. A step takes lambda of its beginning; the pull along the rod that a bend or a twist has for that
/// reason, at most (kappa h)^2/8 k_s, is left out. Source: Ogden 1997, chapter 5 (extension and torsion of a cylinder);
/// the bend is our own.
struct Thinned {
  double bending = 1.0, twisting = 1.0;  ///< [-]
};

/// At inner node i, by the mean stretch of its two edges.
inline Thinned thinned(const RodProperties& rod, const Points& position, Eigen::Index i) {
  const double length = (position.col(i) - position.col(i - 1)).norm() + (position.col(i + 1) - position.col(i)).norm();
  const double stretch = length / (rod.rest_length[i - 1] + rod.rest_length[i]);
  return {respond(rod, i, {1.0, 1.0, stretch}).slope / stretch, 1.0 / stretch};
}

}  // namespace knot_utm
