#pragma once

#include <array>
#include <limits>

#include "knot_utm/contact/friction_law.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// Friction that grows with the logarithm of the speed of slip, as that of elastomers and polymers does. With mu_0 the
/// coefficient at rest, a the rate and v_0 the speed from which on it grows,
///
///     mu(v) = mu_0 (1 + a ln(1 + v/v_0)),      |t| = mu_0 p |xi|/xi_s <= mu(v) p,      v = (|r| - |xi|)/dt.
///
/// Below mu_0 p a contact sticks, and is the spring of `memory`. Under a load q mu_0 p, q > 1, it creeps at
/// v_0 (exp((q - 1)/a) - 1). A contact that slid and stops still bears more than mu_0 p, and gives it up slowly: it
/// creeps on. a = 0 is `memory`.
///
/// With y = |r|/xi_s, e = |xi|/xi_s and c = a xi_s/(v_0 dt), a step that slides solves for u = ln(1 + v/v_0)
///
///     exp(u) + c u = 1 + (y - 1) xi_s/(v_0 dt),      e = 1 + a u,      de/dy = c/(exp(u) + c)
///
/// by Newton's method from above, where the left-hand side is convex and rises. Source: Schallamach 1953 (rubber),
/// Briscoe, Tabor 1975 (polymers) for the logarithm.
struct RateFriction : FrictionLawDefaults {
  static constexpr const char* kName = "rate";
  static constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
  static constexpr std::array kKeys{
      LawKey{"presliding", 1e-5, 0.5, "of the radius", LawDefault::kAccuracy, kNoValue},
      LawKey{"rate", 0.0, 1.0, "-", LawDefault::kNone, kNoValue, "rate; growth for an e-fold of speed"},
      LawKey{"rate_speed", 1e-9, 1.0, "m/s", LawDefault::kNone, kNoValue, "rate speed; where the growth begins"}};

  double coefficient = 0.0;  ///< mu_0 [-]
  double presliding = 0.0;   ///< xi_s [m]
  double rate = 0.0;         ///< a [-]
  double speed = 1.0;        ///< v_0 [m/s]

  RateFriction() = default;
  RateFriction(double mu_0, double xi_s, double a, double v_0)
      : coefficient(mu_0), presliding(xi_s), rate(a), speed(v_0) {}
  static RateFriction of(const FrictionOptions& options, const FrictionScales& scales) {
    return {scales.coefficient, scales.presliding * scales.radius, options.value("rate").value_or(0.0),
            options.value("rate_speed").value_or(1.0)};
  }

  template <typename Vector>
  FrictionTraction<Vector> traction(const FrictionInput<Vector>& in) const {
    const Vector y = (1.0 / presliding) * in.slip;
    const Spring spring(*this, square_root(dot(y, y)), in.dt);
    return {spring.direction() * y, coefficient * spring.cone()};
  }

  template <typename Vector>
  FrictionTangent<Vector> tangent(const FrictionInput<Vector>& in, Linearisation linearisation) const {
    using Real = typename FrictionInput<Vector>::Real;
    const double over_scale = 1.0 / presliding;
    const Vector y = over_scale * in.slip;
    const Spring spring(*this, square_root(dot(y, y)), in.dt);
    // The secant of |t|/(p mu_0) = e, and its slope less the secant.
    const Real across = select(spring.size < 1.0, constant<Real>(1.0), spring.bears / spring.size);
    const Real along = linearisation == Linearisation::kTangent ? Real(spring.slope - across) : Real{};
    const Vector unit = select(spring.size > 1e-12, 1.0 / spring.size, Real{}) * y;
    const Vector z = spring.direction() * y;
    const Real mu = coefficient * spring.cone();
    return {z, mu, mu * z, constant<Real>(coefficient * over_scale), across, along, unit, unit};
  }

  FrictionMemory remember(const FrictionInput<Vec3>& in, const Vec3& z) const {
    const Spring spring(*this, in.slip.norm() / presliding, in.dt);
    return {presliding * spring.cone() * z, 0.0};
  }

 private:
  /// What the tangential spring bears after the slip of this step.
  template <typename Real>
  struct Spring {
    Real size;   // y
    Real bears;  // e
    Real slope;  // de/dy

    Spring(const RateFriction& law, const Real& y, double dt) : size(y), bears(y), slope(constant<Real>(1.0)) {
      if (!any(y >= 1.0)) return;
      const double over = law.presliding / (law.speed * dt), c = law.rate * over;
      const Real right = 1.0 + over * larger(y - 1.0, Real{});
      // Two bounds of u from above: of the left-hand side, either term alone is no larger than the whole.
      Real u = smaller((1.0 / (1.0 + c)) * (right - 1.0), logarithm(right)), grown = exponential(u);
      constexpr int kMostIterations = 40;  // as a rule four to six
      for (int i = 0; i < kMostIterations; ++i) {
        const Real change = (grown + c * u - right) / (grown + c);
        u = u - change;
        grown = exponential(u);
        if (!any(change > 1e-14 * u)) break;
      }
      bears = select(y < 1.0, y, 1.0 + law.rate * u);
      slope = select(y < 1.0, slope, c / (grown + c));
    }
    /// z/y
    Real direction() const { return select(size < 1.0, constant<Real>(1.0), 1.0 / size); }
    /// mu/mu_0
    Real cone() const { return larger(bears, constant<Real>(1.0)); }
  };
  template <typename Real>
  Spring(const RateFriction&, const Real&, double) -> Spring<Real>;
};

}  // namespace knot_utm
