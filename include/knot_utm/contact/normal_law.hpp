#pragma once

#include <cmath>

namespace knot_utm {

/// Normal contact between two strands of radius h, per length of rod: the line pressure p [N/m] as a function of
/// the overlap D = 2h - d [m] of two centrelines at distance d,
///
///     p(D) = K D^2 / (2 delta (1 - D/delta)),   0 < D < delta,
///
/// once continuously differentiable, soft where strands just touch, and without bound as D nears delta: however hard
/// a knot is pulled, its strands overlap by less than delta. Energy per length, with t = D/delta:
/// (K delta^2 / 2) (-ln(1 - t) - t - t^2/2).
///
/// K [N/m^2] belongs to the material and does not change with the mesh or the run; delta [m] is the contact tolerance.
/// Beyond 0.999 delta, where only iterates come, the law goes on along its tangent.
struct NormalLaw {
  double stiffness = 0.0;  ///< K [N/m^2]
  double tolerance = 0.0;  ///< delta [m]

  double pressure(double overlap) const {
    const double t = overlap / tolerance;
    if (t <= 0.0) return 0.0;
    if (t <= kEnd) return 0.5 * stiffness * tolerance * t * t / (1.0 - t);
    return 0.5 * stiffness * tolerance * (kEnd * kEnd / (1.0 - kEnd) + end_slope() * (t - kEnd));
  }
  /// dp/dD [N/m^2]
  double slope(double overlap) const {
    const double t = overlap / tolerance;
    if (t <= 0.0) return 0.0;
    if (t > kEnd) return 0.5 * stiffness * end_slope();
    return 0.5 * stiffness * t * (2.0 - t) / ((1.0 - t) * (1.0 - t));
  }
  /// The overlap at which the law gives this pressure, p >= 0 [m]: the root of D^2 + (2p/K) D - 2 delta p/K
  double overlap_at(double line_pressure) const {
    const double q = line_pressure / stiffness;
    return 2.0 * tolerance * q / (q + std::sqrt(q * (q + 2.0 * tolerance)));
  }
  /// Energy per length, its derivative is p [N]
  double energy(double overlap) const {
    const double t = overlap / tolerance, scale = 0.5 * stiffness * tolerance * tolerance;
    if (t <= 0.0) return 0.0;
    // The series where the three terms of the closed form cancel.
    if (t < 1e-3) return scale * t * t * t * (1.0 / 3.0 + t * (0.25 + t * 0.2));
    if (t <= kEnd) return scale * (-std::log1p(-t) - t - 0.5 * t * t);
    const double beyond = t - kEnd;
    return scale * (-std::log1p(-kEnd) - kEnd - 0.5 * kEnd * kEnd +
                    beyond * (kEnd * kEnd / (1.0 - kEnd) + 0.5 * end_slope() * beyond));
  }

 private:
  static constexpr double kEnd = 0.999;
  static constexpr double end_slope() { return kEnd * (2.0 - kEnd) / ((1.0 - kEnd) * (1.0 - kEnd)); }
};

}  // namespace knot_utm
