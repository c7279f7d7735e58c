#pragma once

#include <algorithm>
#include <cmath>

#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/options.hpp"

namespace knot_utm {

/// Coulomb friction, t = -mu p z with a direction vector z, |z| <= 1, from the slip r [m] at the contact:
///
///     memory     z = y for |y| < 1, else y/|y|,      y = r / xi_s,     r = xi_n + slip of this step
///     smoothed   z = tanh(7.5 |y|) y/|y|,            y = r / (dt v_s), r = slip of this step
///
/// `memory` is a tangential spring with Coulomb return: the state xi = xi_s z stays at the contact, so that a knot
/// at rest stays at rest. xi_s is the presliding displacement (Dahl 1968); as the traction is the pressure times z,
/// its stiffness grows with the pressure. `smoothed` is eq. 12 of the source paper: with
/// gamma = 2 / (1 + exp(-15 v/v_s)) - 1 = tanh(7.5 v/v_s) it creeps under any load.
struct Friction {
  FrictionLaw law = FrictionLaw::kMemory;
  double coefficient = 0.0;     ///< mu [-]
  double presliding = 0.0;      ///< xi_s [m], memory
  double slip_tolerance = 0.0;  ///< v_s [m/s], smoothed
  bool secant = false;          ///< linearised by secants, not by tangents

  void state(Archive& archive) {
    archive.choice("friction law", law, FrictionLaw::kSmoothed);
    archive(coefficient, presliding, slip_tolerance);
  }

  bool on() const { return coefficient > 0.0; }
  bool remembers() const { return law == FrictionLaw::kMemory; }

  /// The slip that saturates (memory) or scales (smoothed) the law in a step of length dt [m]. In the shortest steps
  /// dt v_s would be lost in rounding, and no shorter step would be an easier one.
  double scale(double dt) const {
    return remembers() ? presliding : std::max(dt * slip_tolerance, kLeastSlip * presliding);
  }

  static constexpr double kLeastSlip = 1e-2;  ///< of xi_s, smoothed
};

/// z(y) and C = dz/dy = across 1 + along u u^T, u = y/|y|.
struct FrictionDirection {
  Vec3 z;
  Vec3 u;
  double across, along;

  Vec3 slope_times(const Vec3& v) const { return across * v + (along * u.dot(v)) * u; }
  Mat3 slope() const { return across * Mat3::Identity() + along * u * u.transpose(); }
};

inline Vec3 friction_direction(FrictionLaw law, const Vec3& y) {
  const double size = y.norm();
  if (law == FrictionLaw::kMemory) return size < 1.0 ? y : Vec3(y / size);
  return size > 1e-12 ? Vec3(y * (std::tanh(7.5 * size) / size)) : Vec3(7.5 * y);
}

/// z(y) with dz/dy, or in its place the secant |z|/|y| in every direction. Where a slip is beyond saturation the
/// tangent along it vanishes, and Newton's method may leap from one saturated side to the other for ever; the secant
/// bounds the law from above (Kacanov's method): slow, but it falls from anywhere.
inline FrictionDirection linearised_direction(FrictionLaw law, bool secant, const Vec3& y) {
  const double size = y.norm();
  if (secant && size > 1e-12) {
    const Vec3 z = friction_direction(law, y);
    return {z, y / size, z.norm() / size, 0.0};
  }
  if (law == FrictionLaw::kMemory) {
    if (size < 1.0) return {y, Vec3::Zero(), 1.0, 0.0};
    const Vec3 unit = y / size;
    return {unit, unit, 1.0 / size, -1.0 / size};
  }
  if (size <= 1e-12) return {7.5 * y, Vec3::Zero(), 7.5, 0.0};
  const Vec3 unit = y / size;
  const double value = std::tanh(7.5 * size);
  return {value * unit, unit, value / size, 7.5 * (1.0 - value * value) - value / size};
}

}  // namespace knot_utm
