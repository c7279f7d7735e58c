#pragma once

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

  void state(Archive& archive) {
    archive.choice("friction law", law, FrictionLaw::kSmoothed);
    archive(coefficient, presliding, slip_tolerance);
  }

  bool on() const { return coefficient > 0.0; }
  bool remembers() const { return law == FrictionLaw::kMemory; }

  /// The slip that saturates (memory) or scales (smoothed) the law in a step of length dt [m].
  double scale(double dt) const { return remembers() ? presliding : dt * slip_tolerance; }
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

inline FrictionDirection friction_direction_and_slope(FrictionLaw law, const Vec3& y) {
  const double size = y.norm();
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
