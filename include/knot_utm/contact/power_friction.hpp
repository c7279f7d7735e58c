#pragma once

#include <array>
#include <limits>

#include "knot_utm/contact/return_mapping.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// Friction that grows less than the load, as that of textile fibres does. Where they touch on a few small areas that
/// flatten, friction grows with a power n < 1 of the normal force, F = a N^n. Per length of rod and with mu given at a
/// reference pressure p_r,
///
///     mu(p) = mu ((p + p_0)/(p_r + p_0))^(n - 1),      p_0 = p_r/1000,
///
/// so that mu(p) p is proportional to p^n, except at pressures as small as p_0, and has a finite slope where strands
/// just touch. z and the elastic slip are those of `memory`: a spring up to the presliding displacement xi_s, and
/// return mapping beyond. n = 1 is `memory`. Source: Howell 1953 (the law, and its capstan); Bowden and Tabor 1950 (the
/// areas).
struct PowerFriction : FrictionLawDefaults {
  static constexpr const char* kName = "power";
  static constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
  static constexpr std::array kKeys{LawKey{"presliding", 1e-5, 0.5, "of the radius", LawDefault::kAccuracy, kNoValue},
                                    LawKey{"exponent", 0.5, 1.0, "of the pressure", LawDefault::kNone, kNoValue},
                                    LawKey{"reference_pressure", 1e-3, 1e9, "N/m", LawDefault::kNone, kNoValue,
                                           "reference pressure; at which `friction_coefficient` holds"}};

  double coefficient = 0.0;         ///< mu at p_r [-]
  double presliding = 0.0;          ///< xi_s [m]
  double exponent = 1.0;            ///< n [-]
  double reference_pressure = 1.0;  ///< p_r [N/m]

  PowerFriction() = default;
  PowerFriction(double mu, double xi_s, double n, double p_r)
      : coefficient(mu), presliding(xi_s), exponent(n), reference_pressure(p_r) {}
  static PowerFriction of(const FrictionOptions& options, const FrictionScales& scales) {
    return {scales.coefficient, scales.presliding * scales.radius, options.value("exponent").value_or(1.0),
            options.value("reference_pressure").value_or(1.0)};
  }

  template <typename Vector>
  FrictionTraction<Vector> traction(const FrictionInput<Vector>& in) const {
    return {ReturnMapping<Vector>::of((1.0 / presliding) * in.slip), coefficient_at(in.pressure)};
  }

  template <typename Vector>
  FrictionTangent<Vector> tangent(const FrictionInput<Vector>& in, Linearisation linearisation) const {
    using Real = typename FrictionInput<Vector>::Real;
    const double over_scale = 1.0 / presliding;
    const ReturnMapping<Vector> y(over_scale * in.slip, linearisation);
    const Real mu = coefficient_at(in.pressure), pressure = larger(in.pressure, Real{});
    // d(mu p)/dp = mu (1 + (n - 1) p/(p + p_0))
    const Real by_pressure = mu * (1.0 + (exponent - 1.0) * pressure / (pressure + least()));
    return {y.z, mu, by_pressure * y.z, over_scale * mu, y.across, y.along, y.unit, y.unit};
  }

  FrictionMemory remember(const FrictionInput<Vec3>&, const Vec3& z) const { return {presliding * z, 0.0}; }

 private:
  /// p_0 [N/m]
  double least() const { return 1e-3 * reference_pressure; }

  /// The linear model of a contact asks for negative pressures, too, where strands have just been drawn apart
  /// (ContactModel). There friction goes on in a straight line with the slope that it has at zero.
  template <typename Real>
  Real coefficient_at(const Real& pressure) const {
    const Real pressed = larger(pressure, Real{});
    return coefficient * power((pressed + least()) / (reference_pressure + least()), exponent - 1.0);
  }
};

}  // namespace knot_utm
