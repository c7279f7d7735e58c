#pragma once

#include <cmath>

namespace knot_utm {

/// Normal contact between two strands of radius h, per length of rod: the line pressure p [N/m] as a function of
/// the overlap D = 2h - d [m] of two centrelines at distance d,
///
///     p = 0             D <= 0
///     p = K D^2 / 2 delta     D <= delta
///     p = K (D - delta / 2)   beyond,
///
/// once continuously differentiable. K [N/m^2] belongs to the material and does not change with the mesh;
/// delta [m] is the contact tolerance.
struct NormalLaw {
  double stiffness = 0.0;  ///< K [N/m^2]
  double tolerance = 0.0;  ///< delta [m]

  double pressure(double overlap) const {
    if (overlap <= 0.0) return 0.0;
    return overlap < tolerance ? 0.5 * stiffness * overlap * overlap / tolerance
                               : stiffness * (overlap - 0.5 * tolerance);
  }
  /// dp/dD [N/m^2]
  double slope(double overlap) const {
    if (overlap <= 0.0) return 0.0;
    return overlap < tolerance ? stiffness * overlap / tolerance : stiffness;
  }
  /// The overlap at which the law gives this pressure, p >= 0 [m]
  double overlap_at(double pressure_) const {
    const double toe = 0.5 * stiffness * tolerance;
    return pressure_ < toe ? std::sqrt(2.0 * tolerance * pressure_ / stiffness) : pressure_ / stiffness + 0.5 * tolerance;
  }
  /// Energy per length, its derivative is p [N]
  double energy(double overlap) const {
    if (overlap <= 0.0) return 0.0;
    if (overlap < tolerance) return stiffness * overlap * overlap * overlap / (6.0 * tolerance);
    return stiffness * (0.5 * overlap * overlap - 0.5 * overlap * tolerance + tolerance * tolerance / 6.0);
  }
};

}  // namespace knot_utm
