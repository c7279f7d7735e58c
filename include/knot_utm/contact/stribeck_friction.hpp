#pragma once

#include <array>
#include <limits>

#include "knot_utm/contact/friction_law.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// Friction that falls as a contact slides, from a static to a kinetic coefficient within a slip length. With sigma the
/// distance that the contact has slid since it last stuck, mu_s the static coefficient and k the ratio of the kinetic
/// one to it,
///
///     mu(sigma) = mu_s (k + (1 - k) exp(-sigma/l)),      sigma = sigma_n + max(0, |r| - xi_s mu(sigma_n)/mu_s),
///     t = -p mu_s y while |y| < mu(sigma)/mu_s, else -p mu(sigma) y/|y|,      y = r/xi_s.
///
/// Below its cone it is the spring of `memory`. A contact that sticks at the end of a step starts anew with sigma = 0,
/// as does a new contact. k = 1 is `memory`. Where l is shorter than (1 - k) xi_s, friction falls faster than the
/// spring unloads, and a step may have no solution. Source: Rabinowicz 1951 for the slip length; a return mapping with
/// softening, as in Simo and Laursen 1992.
struct StribeckFriction : FrictionLawDefaults {
  static constexpr const char* kName = "stribeck";
  static constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
  static constexpr std::array kKeys{
      LawKey{"presliding", 1e-5, 0.5, "of the radius", LawDefault::kAccuracy, kNoValue},
      LawKey{"kinetic_share", 0.0, 1.0, "of friction_coefficient", LawDefault::kNone, kNoValue},
      LawKey{"slip_length", 1e-3, 100.0, "of the radius", LawDefault::kNone, kNoValue}};

  double coefficient = 0.0;       ///< mu_s [-]
  double presliding = 0.0;        ///< xi_s [m]
  double kinetic_fraction = 1.0;  ///< k [-]
  double slip_length = 0.0;       ///< l [m]

  StribeckFriction() = default;
  StribeckFriction(double mu_s, double xi_s, double k, double l)
      : coefficient(mu_s), presliding(xi_s), kinetic_fraction(k), slip_length(l) {}
  static StribeckFriction of(const FrictionOptions& options, const FrictionScales& scales);

  template <typename Vector>
  FrictionTraction<Vector> traction(const FrictionInput<Vector>& in) const {
    const Vector y = (1.0 / presliding) * in.slip;
    const Cone cone(*this, square_root(dot(y, y)), in.own);
    return {select(cone.size < cone.bears, 1.0 / cone.bears, 1.0 / cone.size) * y, coefficient * cone.bears};
  }

  template <typename Vector>
  FrictionTangent<Vector> tangent(const FrictionInput<Vector>& in, Linearisation linearisation) const {
    using Real = typename FrictionInput<Vector>::Real;
    const double over_scale = 1.0 / presliding;
    const Vector y = over_scale * in.slip;
    const Cone cone(*this, square_root(dot(y, y)), in.own);
    const Real& size = cone.size;
    const auto sticks = size < cone.bears;
    // The secant of |t|/(p mu_s) = min(|y|, bears), and its slope less the secant.
    const Real across = select(sticks, constant<Real>(1.0), cone.bears / size);
    Real along = Real{};
    if (linearisation == Linearisation::kTangent) along = select(sticks, along, cone.slope - across);
    const Vector unit = select(size > 1e-12, 1.0 / size, Real{}) * y;
    const Vector z = select(sticks, 1.0 / cone.bears, 1.0 / size) * y;
    const Real mu = coefficient * cone.bears;
    return {z, mu, mu * z, constant<Real>(coefficient * over_scale), across, along, unit, unit};
  }

  FrictionMemory remember(const FrictionInput<Vec3>& in, const Vec3& z) const;

  void state(Archive& archive) { archive(coefficient, presliding, kinetic_fraction, slip_length); }

 private:
  /// The largest traction after the slip of this step, divided by mu_s p, and its derivative in |y|.
  template <typename Real>
  struct Cone {
    Real size;   // |y|
    Real bears;  // mu(sigma)/mu_s
    Real slope;  // d bears/d|y|

    Cone(const StribeckFriction& law, const Real& y, const Real& slid) : size(y) {
      const double k = law.kinetic_fraction, over_length = 1.0 / law.slip_length;
      const Real before = k + (1.0 - k) * exponential(-over_length * slid);
      const Real slip = law.presliding * (y - before);
      const Real left = (1.0 - k) * exponential(-over_length * (slid + larger(slip, Real{})));
      bears = k + left;
      slope = -law.presliding * over_length * left;
    }
  };
  template <typename Real>
  Cone(const StribeckFriction&, const Real&, const Real&) -> Cone<Real>;
};

}  // namespace knot_utm
