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

  bool on() const { return coefficient > 0.0; }
  bool remembers() const { return law == FrictionLaw::kMemory; }

  /// The slip that saturates (memory) or scales (smoothed) the law in a step of length dt [m].
  double scale(double dt) const { return remembers() ? presliding : dt * slip_tolerance; }
};

/// z(y) and C = dz/dy.
struct FrictionDirection {
  Vec3 z;
  Mat3 slope;
};

inline Vec3 friction_direction(FrictionLaw law, const Vec3& y) {
  const double size = y.norm();
  if (law == FrictionLaw::kMemory) return size < 1.0 ? y : Vec3(y / size);
  return size > 1e-12 ? Vec3(y * (std::tanh(7.5 * size) / size)) : Vec3(7.5 * y);
}

inline FrictionDirection friction_direction_and_slope(FrictionLaw law, const Vec3& y) {
  FrictionDirection out;
  const double size = y.norm();
  if (law == FrictionLaw::kMemory) {
    if (size < 1.0) {
      out.z = y;
      out.slope.setIdentity();
      return out;
    }
    out.z = y / size;
    out.slope = (Mat3::Identity() - out.z * out.z.transpose()) / size;
    return out;
  }
  if (size <= 1e-12) {
    out.z = 7.5 * y;
    out.slope = 7.5 * Mat3::Identity();
    return out;
  }
  const Vec3 unit = y / size;
  const double value = std::tanh(7.5 * size);
  out.z = value * unit;
  out.slope = (7.5 * (1.0 - value * value)) * unit * unit.transpose() +
              (value / size) * (Mat3::Identity() - unit * unit.transpose());
  return out;
}

}  // namespace knot_utm
