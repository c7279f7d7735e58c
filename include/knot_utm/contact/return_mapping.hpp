#pragma once

#include "knot_utm/contact/friction_law.hpp"

namespace knot_utm {

/// Return mapping of a tangential spring to Coulomb's cone, of one contact or of four side by side:
///
///     z = y for |y| < 1, else y/|y|,      dz/dy = across 1 + along unit unit^T
///
/// y [-] is the displacement of the spring over the presliding displacement, and z [-] what the contact bears of it, as
/// the traction over mu p. Source: Simo, Hughes 1998, section 1.2.
template <typename Vector>
struct ReturnMapping {
  using Real = typename FrictionInput<Vector>::Real;
  Vector z;
  Real across;  ///< |z|/|y| [-]
  Real along;   ///< d|z|/d|y| - |z|/|y| [-]; 0 for the secant
  Vector unit;  ///< y/|y| [-]; 0 where y is

  ReturnMapping(const Vector& y, Linearisation linearisation) {
    const Real size = square_root(dot(y, y));
    across = ratio(size);
    along = Real{};
    if (linearisation == Linearisation::kTangent) along = select(size < 1.0, along, -across);
    unit = select(size > 1e-12, 1.0 / size, Real{}) * y;
    z = across * y;
  }

  /// z alone.
  static Vector of(const Vector& y) { return ratio(Real(square_root(dot(y, y)))) * y; }

 private:
  static Real ratio(const Real& size) { return select(size < 1.0, constant<Real>(1.0), 1.0 / size); }
};

}  // namespace knot_utm
