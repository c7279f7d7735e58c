#pragma once

#include <cmath>
#include <limits>

#include "knot_utm/numeric/lanes.hpp"

namespace knot_utm {

/// The pressure law of two strands of radius h: the line pressure p [N/m] as a function of the overlap D = 2h - d [m]
/// of two centrelines at distance d,
///
///     p = K s (1 + (s/c)^4),      s = (D + delta/2)^2 / (2 delta)  for |D| < delta/2,   s = D beyond, 0 before,
///
/// once continuously differentiable. K [N/m^2] and the depth c [m] from which the rod stiffens as it is squeezed belong
/// to the material and do not change with the mesh, the step or the run. The contact tolerance delta only rounds the
/// corner where strands just touch, symmetrically about D = 0. A contact with a pressure above K delta/2 does not
/// depend on it.
///
/// pressure, slope and overlap_at are templates: of a double, or of Lanes for four contacts side by side.
struct NormalLaw {
  double stiffness = 0.0;                                       ///< K [N/m^2]
  double tolerance = 0.0;                                       ///< delta [m]
  double stiffening = std::numeric_limits<double>::infinity();  ///< c [m]

  /// Of one such strand on a body that does not give: it alone is flattened by what two would share, p(2 D).
  NormalLaw on_rigid() const { return {2.0 * stiffness, 0.5 * tolerance, 0.5 * stiffening}; }

  /// Overlap at which the pressure begins, below zero [m].
  double begin() const { return -0.5 * tolerance; }
  double stiffens_at() const { return stiffening; }

  /// `Real`: double, or Lanes for four contacts at once.
  template <typename Real>
  Real pressure(const Real& overlap) const {
    const Real s = squeeze(overlap);
    return select(overlap <= begin(), Real{}, stiffness * s * (1.0 + fourth(s / stiffening)));
  }
  /// dp/dD [N/m^2]
  template <typename Real>
  Real slope(const Real& overlap) const {
    const Real rounded = (overlap - begin()) / tolerance;
    const Real ds = select(rounded < 1.0, rounded, constant<Real>(1.0));
    return select(overlap <= begin(), Real{}, stiffness * ds * (1.0 + 5.0 * fourth(squeeze(overlap) / stiffening)));
  }
  /// The overlap at which the law gives this pressure, p >= 0 [m]
  template <typename Real>
  Real overlap_at(const Real& line_pressure) const {
    // Newton's method on s (1 + (s/c)^4) = p/K, which is convex, so that a start above the root descends to it.
    const Real q = line_pressure / stiffness;
    Real s = select(q < stiffening, q, stiffening * square_root(square_root(q / stiffening)));
    for (int i = 0; i < 6; ++i) {
      const Real t4 = fourth(s / stiffening), excess = s * (1.0 + t4) - q;
      s -= excess / (1.0 + 5.0 * t4);
      if (!any(excess > 1e-9 * q)) break;
    }
    return select(s >= 0.5 * tolerance, s, square_root(2.0 * tolerance * s) + begin());
  }
  /// Energy per length, its derivative is p [N]
  double energy(double overlap) const {
    const double w = overlap - begin();
    if (w <= 0.0) return 0.0;
    // In the corner s = w^2/(2 delta), the integrals of s and s^5 over w are w s/3 and w s^5/11.
    auto corner = [&](double depth) {
      const double s = 0.5 * depth * depth / tolerance;
      return stiffness * depth * s * (1.0 / 3.0 + fourth(s / stiffening) / 11.0);
    };
    auto beyond = [&](double s) { return stiffness * s * s * (0.5 + fourth(s / stiffening) / 6.0); };
    return w <= tolerance ? corner(w) : corner(tolerance) + beyond(overlap) - beyond(0.5 * tolerance);
  }

 private:
  template <typename Real>
  static Real fourth(const Real& x) {
    return x * x * x * x;
  }
  template <typename Real>
  Real squeeze(const Real& overlap) const {
    const Real w = overlap - begin();
    return select(w < tolerance, 0.5 * w * w / tolerance, overlap);
  }
};

}  // namespace knot_utm
