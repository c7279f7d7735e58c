#pragma once

#include <algorithm>
#include <array>

#include "knot_utm/contact/friction_law.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// Coulomb friction smoothed by the speed of slip, eq. 12 of the source paper,
///
///     z = tanh(7.5 |y|) y/|y|,      y = r / max(dt v_s, least slip),     nothing is remembered:
///
/// with gamma = 2 / (1 + exp(-15 v/v_s)) - 1 = tanh(7.5 v/v_s) it creeps under any load.
struct SmoothedFriction : FrictionLawDefaults {
  static constexpr const char* kName = "smoothed";
  static constexpr double kPlainTolerance = 1e-3;  // v_s of a method that says nothing of it [m/s]
  // The least slip over which friction turns, as a fraction of the presliding displacement. With a hundredth of it
  // strands that whip at m/s in steps of microseconds took 15 iterations a step, and three draws of the stability
  // matrix went nowhere.
  static constexpr double kLeastSlip = 1e-1;
  static constexpr std::array kKeys{LawKey{"slip_tolerance", 1e-7, 0.1, "m/s", LawDefault::kCreep, kPlainTolerance}};

  double coefficient = 0.0;     ///< mu [-]
  double slip_tolerance = 0.0;  ///< v_s [m/s]
  double least_slip = 0.0;      ///< least slip, without which short steps would be too steep to solve [m]

  SmoothedFriction() = default;
  SmoothedFriction(double mu, double v_s, double least = 0.0)
      : coefficient(mu), slip_tolerance(v_s), least_slip(least) {}
  static SmoothedFriction of(const FrictionOptions& options, const FrictionScales& scales) {
    return {scales.coefficient, options.value("slip_tolerance").value_or(kPlainTolerance),
            kLeastSlip * scales.presliding * scales.radius};
  }

  /// What the slip is divided by [m]: dt v_s, but at least `least_slip`.
  double scale(double dt) const { return std::max(dt * slip_tolerance, least_slip); }

  template <typename Vector>
  FrictionTraction<Vector> traction(const FrictionInput<Vector>& in) const {
    const Vector y = (1.0 / scale(in.dt)) * in.slip;
    const auto size = square_root(dot(y, y));
    return {ratio(size) * y, constant<decltype(dot(y, y))>(coefficient)};
  }

  template <typename Vector>
  FrictionTangent<Vector> tangent(const FrictionInput<Vector>& in, Linearisation linearisation) const {
    using Real = typename FrictionInput<Vector>::Real;
    const double over_scale = 1.0 / scale(in.dt);
    const Vector y = over_scale * in.slip;
    const Real size = square_root(dot(y, y)), across = ratio(size);
    Real along = Real{};  // d|z|/d|y| - |z|/|y|
    if (linearisation == Linearisation::kTangent) {
      const Real value = across * size;
      along = select(size > 1e-12, 7.5 * (1.0 - value * value) - across, along);
    }
    const Vector unit = select(size > 1e-12, 1.0 / size, Real{}) * y;
    const Vector z = across * y;
    const Real mu = constant<Real>(coefficient);
    return {z, mu, mu * z, constant<Real>(coefficient * over_scale), across, along, unit, unit};
  }

  FrictionMemory remember(const FrictionInput<Vec3>&, const Vec3&) const { return {}; }
  double creep_speed() const { return slip_tolerance; }

 private:
  /// |z|/|y|
  template <typename Real>
  static Real ratio(const Real& size) {
    return select(size > 1e-12, tanh(7.5 * size) / size, constant<Real>(7.5));
  }
};

}  // namespace knot_utm
