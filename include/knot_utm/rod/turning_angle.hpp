#pragma once

#include <array>
#include <cmath>

#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// Bending is measured by the angle phi by which the rod turns at a node: phi over the Voronoi length is the curvature
/// of an arc that has the rod's own length, whatever the length of the edges. The common measure 2 tan(phi/2) makes a
/// bend of radius R too stiff by (edge/R)^2/6.
///
///   w = |t_f - t_e|^2/4 = (1 - c)/2 = sin^2(phi/2),   t_e, t_f unit tangents of the two edges, c = t_e . t_f
///   phi^2 = 4 asin^2(sqrt(w)) = sum_{n>=1} a_n w^n,   a_1 = 4,   a_{n+1}/a_n = 2 n^2/((n + 1) (2 n + 1))
///
/// From term N on, all coefficients are taken as large as a_N, so that the rest of the series is a_N w^N/(1 - w). The
/// resulting squared angle g needs neither root nor arc function and is smooth everywhere. It is phi^2 to 8e-10 of it
/// at 0.5 rad, to 3e-6 at 1 rad and to 5e-4 at a right angle. Beyond that the edges do not resolve a bend, and g grows
/// without bound towards phi = pi, where phi^2 itself would let a rod under tension fold back on itself. With more
/// terms g follows phi^2 further and then rises so steeply that Newton's method no longer comes out of a fold.
/// Source: y = asin(x)^2 solves (1 - x^2) y'' - x y' = 2, which gives the series; the replaced remainder is our own.
///
/// G = g/w and its derivatives G' and G'' in w, for one number or for four (lanes.hpp). g = w G keeps its digits where
/// the rod is nearly straight.
template <typename Real>
struct SquaredAngleOverW {
  Real value, first, second;  ///< G, dG/dw, d2G/dw2 [-]
};

inline constexpr int kTurningTerms = 6;  // N

/// a_N, and a_n - a_N for n = 1 ... N-1: since w^N/(1-w) = 1/(1-w) - 1 - w - ... - w^(N-1),
/// G = a_N/(1-w) + sum_{n<N} (a_n - a_N) w^(n-1).
struct TurningSeries {
  double last = 4.0;
  std::array<double, kTurningTerms - 1> less_last{};

  constexpr TurningSeries() {
    for (int n = 1; n < kTurningTerms; ++n) {
      less_last[static_cast<std::size_t>(n - 1)] = last;
      last *= 2.0 * n * n / ((n + 1.0) * (2.0 * n + 1.0));
    }
    for (double& each : less_last) each -= last;
  }
};
inline constexpr TurningSeries kTurningSeries;

template <typename Real>
SquaredAngleOverW<Real> squared_angle_over(const Real& w) {
  Real value{}, first{}, half_second{};
  for (std::size_t n = kTurningSeries.less_last.size(); n-- > 0;) {  // Horner's rule, and its derivatives
    half_second = half_second * w + first;
    first = first * w + value;
    value = value * w + kTurningSeries.less_last[n];
  }
  const Real pole = 1.0 / (1.0 - w), last = kTurningSeries.last * pole;
  return {value + last, first + last * pole, 2.0 * (half_second + last * pole * pole)};
}

/// phi itself [rad], 0 to pi.
inline double turning_angle(const Vec3& t_e, const Vec3& t_f) {
  return 2.0 * std::atan2((t_f - t_e).norm(), (t_f + t_e).norm());
}

}  // namespace knot_utm
