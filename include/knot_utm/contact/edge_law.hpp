#pragma once

#include <cmath>

namespace knot_utm {

/// The source paper's penalty between two edges (its eqs. 10-11), as a function of the overlap D = 2h - Delta [m] of
/// centrelines at the smallest distance Delta. Energy E = K f / 2 per length of rod [N], with
///
///     f = D^2                                 D >= delta
///     f = [ log(1 + exp(K1 D)) / K1 ]^2       -delta < D < delta,  K1 = 15 / delta
///     f = 0                                   beyond,
///
/// and the line pressure p = dE/dD [N/m]. At D = 0 the pressure is log(2) K delta/30. K [N/m^2] is the same as in
/// NormalLaw: pressure per overlap once pressed in.
struct EdgeLaw {
  double stiffness = 0.0;  ///< K [N/m^2]
  double tolerance = 0.0;  ///< delta [m]

  /// Overlap at which the law begins [m].
  double begin() const { return -tolerance; }

  double pressure(double overlap) const {
    if (overlap <= begin()) return 0.0;
    if (overlap >= tolerance) return stiffness * overlap;
    return stiffness * soft_overlap(overlap) * fraction(overlap);
  }
  /// dp/dD [N/m^2]
  double slope(double overlap) const {
    if (overlap <= begin()) return 0.0;
    if (overlap >= tolerance) return stiffness;
    const double s = fraction(overlap);
    return stiffness * (s * s + sharpness() * soft_overlap(overlap) * s * (1.0 - s));
  }
  /// Energy per length [N]
  double energy(double overlap) const {
    if (overlap <= begin()) return 0.0;
    const double depth = overlap >= tolerance ? overlap : soft_overlap(overlap);
    return 0.5 * stiffness * depth * depth;
  }
  /// The overlap at which the law gives this pressure, p > 0 [m].
  double overlap_at(double pressure_) const {
    if (pressure_ >= stiffness * tolerance) return pressure_ / stiffness;
    // log p is a concave, rising function of y = K1 D: Newton's method climbs to the root from below.
    const double target = std::log(pressure_ * sharpness() / stiffness);
    double y = 0.5 * target - 1.0;
    for (int i = 0; i < 50; ++i) {
      const double soft = std::log1p(std::exp(y)), s = 1.0 / (1.0 + std::exp(-y));
      const double change = (target - std::log(soft * s)) / (s / soft + 1.0 - s);
      y += change;
      if (std::abs(change) < 1e-12) break;
    }
    return y / sharpness();
  }

 private:
  double sharpness() const { return 15.0 / tolerance; }  // K1 [1/m]
  double soft_overlap(double overlap) const { return std::log1p(std::exp(sharpness() * overlap)) / sharpness(); }
  double fraction(double overlap) const { return 1.0 / (1.0 + std::exp(-sharpness() * overlap)); }
};

}  // namespace knot_utm
