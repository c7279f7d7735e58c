#pragma once

#include "knot_utm/contact/friction_options.hpp"
#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/lanes.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// The interface of a friction law. At every contact a law gives the traction t [N/m] that acts along the surface on
/// the strand of point a, by a direction vector z and a friction coefficient mu,
///
///     t = -mu p z,   |z| <= 1,
///
/// as a function of the pressure p, of the slip r (the elastic slip that it keeps plus the slip of this step), of an
/// internal variable of its own, and of the length dt of the step. Both z and mu may depend on all of these.
///
/// A law that depends on the speed of slip has it from r and dt. A law that keeps no elastic slip slides by all of r in
/// the step, v = |r|/dt. Of a law with a tangential spring, the spring holds a part xi of r, and v = (|r| - |xi|)/dt.
/// As xi grows with the traction, which depends on v, the law solves both together.
///
/// A law is a header and one line in `FrictionLaws` (friction.hpp). It is a plain struct, which has
///
///     static constexpr const char* kName              the name that methods use
///     static constexpr std::array kKeys               its keys in physics.friction (LawKey)
///     static Law of(options, scales)                  made from a method
///     double coefficient                              mu of the method [-]; 0: no friction. Where mu depends on more
///                                                     than the material, the law says which of its values this is
///     traction(FrictionInput<Vector>)                 -> FrictionTraction<Vector>
///     tangent(FrictionInput<Vector>, Linearisation)   -> FrictionTangent<Vector>
///     remember(FrictionInput<Vec3>, z)                -> FrictionMemory, once the step is accepted with this z
///
/// Traction and tangent are templates: `Vector` is Vec3 for one contact, or FourVectors for four side by side; Real is
/// the number type that belongs to it. They make no virtual calls and allocate nothing.
///
/// Defaults that a law inherits and may replace:
struct FrictionLawDefaults {
  /// Speed with which contacts at rest creep under any load; 0: they hold [m/s].
  double creep_speed() const { return 0.0; }
  /// Whether the errors beside readings were studied with this law (settings/accuracy.hpp).
  static constexpr bool kStudied = false;
};

/// What a contact keeps from step to step. A new contact begins with zeros.
struct FrictionMemory {
  Vec3 slip = Vec3::Zero();  ///< xi [m]
  double own = 0.0;          ///< internal variable of the law
  /// rho_n of RollingResistance [m]; archived by the contacts where they have one.
  double rolled = 0.0;

  void state(Archive& archive) { archive(slip, own); }
};

/// What a law knows of one contact, or of four.
template <typename Vector>
struct FrictionInput {
  using Real = decltype(dot(Vector(), Vector()));
  Real pressure;      ///< p [N/m]
  Vector slip;        ///< r: xi_n plus the slip of this step, in the tangent plane [m]
  Vector remembered;  ///< xi_n of the last accepted step, not in the present tangent plane, which has turned since [m]
  Vector along;       ///< of the strand that is slid on, not of unit length, for laws with directions; 0 on a roller
  Real own;           ///< internal variable of the law, of the last accepted step
  double dt;          ///< [s]
};

template <typename Vector>
struct FrictionTraction {
  using Real = typename FrictionInput<Vector>::Real;
  Vector z;
  Real coefficient;  ///< mu [-]
};

/// The traction and its derivatives,
///
///     -dt/dp = by_pressure,     -dt/dr = p stiffness C,     C = across 1 + along left right^T,
///
/// left and right in the tangent plane. For a law without directions both are r/|r|.
template <typename Vector>
struct FrictionTangent {
  using Real = typename FrictionInput<Vector>::Real;
  Vector z;
  Real coefficient;    ///< mu [-]
  Vector by_pressure;  ///< [-]
  Real stiffness;      ///< [1/m]
  Real across, along;  ///< [-]
  Vector left, right;  ///< [-]

  /// C v
  Vector slope_times(const Vector& v) const { return across * v + (along * dot(right, v)) * left; }
};

/// Newton's method solves with the tangent, or instead with the secant |z|/|r| in every direction. Beyond saturation
/// the tangent along the slip vanishes, and Newton's method may jump for ever from one saturated side to the other. The
/// secant bounds the law from above (Kacanov's method) and converges slowly, but from any start.
enum class Linearisation { kTangent, kSecant };

/// What a law's parameters depend on besides its keys.
struct FrictionScales {
  double coefficient = 0.0;  ///< mu of the two that touch [-]
  double radius = 0.0;       ///< h [m]
  double presliding = 0.0;   ///< slip at which friction that remembers saturates [h]
};

}  // namespace knot_utm
