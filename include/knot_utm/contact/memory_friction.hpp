#pragma once

#include <array>
#include <limits>

#include "knot_utm/contact/return_mapping.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// Coulomb friction with presliding: a tangential spring with return mapping to Coulomb's cone,
///
///     z = y for |y| < 1, else y/|y|,      y = r / xi_s,     xi = xi_s z is remembered,
///
/// so that a knot at rest stays at rest. xi_s is the presliding displacement (Dahl 1968); as the traction is the
/// pressure times z, its stiffness grows with the pressure.
struct MemoryFriction : FrictionLawDefaults {
  static constexpr const char* kName = "memory";
  static constexpr std::array kKeys{LawKey{"presliding", 1e-5, 0.5, "of the radius", LawDefault::kAccuracy,
                                           std::numeric_limits<double>::quiet_NaN()}};
  static constexpr bool kStudied = true;

  double coefficient = 0.0;  ///< mu [-]
  double presliding = 0.0;   ///< xi_s [m]

  MemoryFriction() = default;
  MemoryFriction(double mu, double xi_s) : coefficient(mu), presliding(xi_s) {}
  static MemoryFriction of(const FrictionOptions&, const FrictionScales& scales) {
    return {scales.coefficient, scales.presliding * scales.radius};
  }

  template <typename Vector>
  FrictionTraction<Vector> traction(const FrictionInput<Vector>& in) const {
    using Real = typename FrictionInput<Vector>::Real;
    return {ReturnMapping<Vector>::of((1.0 / presliding) * in.slip), constant<Real>(coefficient)};
  }

  template <typename Vector>
  FrictionTangent<Vector> tangent(const FrictionInput<Vector>& in, Linearisation linearisation) const {
    using Real = typename FrictionInput<Vector>::Real;
    const double over_scale = 1.0 / presliding;
    const ReturnMapping<Vector> y(over_scale * in.slip, linearisation);
    const Real mu = constant<Real>(coefficient);
    return {y.z, mu, mu * y.z, constant<Real>(coefficient * over_scale), y.across, y.along, y.unit, y.unit};
  }

  FrictionMemory remember(const FrictionInput<Vec3>&, const Vec3& z) const { return {presliding * z, 0.0}; }
};

}  // namespace knot_utm
