// A friction law of your own: Tresca's limit. A law is this header and its name in the list of laws (CONTRIBUTING.md,
// "A friction law", has these two edits); methods then know its keys. A bending law is added in the same way.
// Run:  cp examples/law_of_your_own.hpp include/knot_utm/contact/tresca_friction.hpp
//       edit include/knot_utm/contact/friction.hpp && scripts/build tensile_test
//       build/devel/lib/knot_utm/tensile_test tighten --set 'physics.friction={law: tresca, shear_limit: 300}'
// Test: test/contributing/friction_law_test.py
#pragma once

#include <array>
#include <limits>

#include "knot_utm/contact/return_mapping.hpp"

namespace knot_utm {

/// Coulomb friction with a presliding spring, and with a traction of at most tau, mu(p) = min(mu, tau/p).
struct TrescaFriction : FrictionLawDefaults {
  static constexpr const char* kName = "tresca";
  static constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
  static constexpr std::array kKeys{LawKey{"presliding", 1e-5, 0.5, "of the radius", LawDefault::kAccuracy, kNoValue},
                                    LawKey{"shear_limit", 1e-6, 1e9, "N/m", LawDefault::kNone, kNoValue}};

  double coefficient = 0.0, presliding = 1.0, limit = 0.0;  ///< mu [-], xi_s [m], tau [N/m]

  static TrescaFriction of(const FrictionOptions& options, const FrictionScales& scales) {
    TrescaFriction law;
    law.coefficient = scales.coefficient;
    law.presliding = scales.presliding * scales.radius;
    law.limit = options.value("shear_limit").value_or(std::numeric_limits<double>::infinity());
    return law;
  }

  template <typename Vector>
  FrictionTraction<Vector> traction(const FrictionInput<Vector>& in) const {
    return {ReturnMapping<Vector>::of((1.0 / presliding) * in.slip), at(in.pressure)};
  }
  template <typename Vector>
  FrictionTangent<Vector> tangent(const FrictionInput<Vector>& in, Linearisation linearisation) const {
    using Real = typename FrictionInput<Vector>::Real;
    const ReturnMapping<Vector> y((1.0 / presliding) * in.slip, linearisation);
    const Real mu = at(in.pressure), by_pressure = select(coefficient * in.pressure < limit, mu, Real{});
    return {y.z, mu, by_pressure * y.z, (1.0 / presliding) * mu, y.across, y.along, y.unit, y.unit};
  }
  template <typename Real>
  Real at(const Real& pressure) const {
    return select(coefficient * pressure < limit, constant<Real>(coefficient), limit / pressure);
  }
  FrictionMemory remember(const FrictionInput<Vec3>&, const Vec3& z) const { return {presliding * z, 0.0}; }
  void state(Archive& archive) { archive(coefficient, presliding, limit); }
};

}  // namespace knot_utm
