#pragma once

#include <algorithm>
#include <cmath>

#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/options.hpp"
#include "knot_utm/solver/lanes.hpp"

namespace knot_utm {

/// Coulomb friction, t = -mu p z with a direction vector z, |z| <= 1, from the slip r [m] at the contact:
///
///     memory     z = y for |y| < 1, else y/|y|,      y = r / xi_s,     r = xi_n + slip of this step
///     smoothed   z = tanh(7.5 |y|) y/|y|,            y = r / (dt v_s), r = slip of this step
///
/// `memory` is a tangential spring with a return mapping to Coulomb's cone: xi = xi_s z is kept at the contact, so that
/// a knot at rest stays at rest. xi_s is the presliding displacement (Dahl 1968); as the traction is the pressure times
/// z, its stiffness grows with the pressure. `smoothed` is eq. 12 of the source paper: with gamma = 2 / (1 + exp(-15
/// v/v_s)) - 1 = tanh(7.5 v/v_s) it creeps under any load.
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

/// z(y) and C = dz/dy = across 1 + along u u^T, u = y/|y|, of one contact or (FourVectors) of four.
template <typename Vector>
struct FrictionDirection {
  using Real = decltype(dot(Vector(), Vector()));
  Vector z;
  Vector u;
  Real across, along;

  Vector slope_times(const Vector& v) const { return across * v + (along * dot(u, v)) * u; }
  Mat3 slope() const { return across * Mat3::Identity() + along * u * u.transpose(); }
};

namespace friction {

/// |z|/|y| at |y| = size.
template <typename Real>
Real secant(FrictionLaw law, const Real& size) {
  if (law == FrictionLaw::kMemory) return select(size < 1.0, constant<Real>(1.0), 1.0 / size);
  return select(size > 1e-12, tanh(7.5 * size) / size, constant<Real>(7.5));
}

}  // namespace friction

template <typename Vector>
Vector friction_direction(FrictionLaw law, const Vector& y) {
  return friction::secant(law, square_root(dot(y, y))) * y;
}

/// z(y) with dz/dy, or in its place the secant |z|/|y| in every direction. Where a slip is beyond saturation the
/// tangent along it vanishes, and Newton's method may leap from one saturated side to the other for ever; the secant
/// bounds the law from above (Kacanov's method): it converges slowly, but from any start.
template <typename Vector>
FrictionDirection<Vector> linearised_direction(FrictionLaw law, bool secant, const Vector& y) {
  using Real = decltype(dot(y, y));
  const Real size = square_root(dot(y, y)), across = friction::secant(law, size);
  Real along = Real{};  // d|z|/d|y| - |z|/|y|
  if (!secant && law == FrictionLaw::kMemory) along = select(size < 1.0, along, -across);
  if (!secant && law == FrictionLaw::kSmoothed) {
    const Real value = across * size;
    along = select(size > 1e-12, 7.5 * (1.0 - value * value) - across, along);
  }
  const Vector unit = select(size > 1e-12, 1.0 / size, Real{}) * y;
  return {across * y, unit, across, along};
}

}  // namespace knot_utm
