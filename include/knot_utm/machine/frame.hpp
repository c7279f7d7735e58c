#pragma once

#include "knot_utm/machine/options.hpp"

namespace knot_utm {

struct Material;

/// The machine's frame, load train and crosshead drive as one spring of stiffness K [N/m] between the crosshead, which
/// travels D, and the upper grip, which moves by g less: F = K (D - g) at rest, F the force of the specimen on the
/// grip.
///
/// A step of length dt moves the grip from g to g' such that
///
///     K (D' - g') = F + (k + c/dt + m/dt^2) (g' - g)        F at the beginning of the step
///
/// n strands resist a motion of their grip by at most k + n Z/dt. k = n k_s/l is their stiffness once taut, over the
/// length l from the grip to what else holds them. Z = sqrt(k_s rho A) is the impedance of the wave that the grip sends
/// along each. The right-hand side is thus no less than F at the end of the step, and the grip approaches its place
/// from one side, whatever K and dt are. c = n Z + K tau; tau stands for the inertia of crosshead and grip, without
/// which they would whip to and fro when a rod snaps.
///
/// The rod around a roller moves with it, so that F contains the inertia force of its mass m_a = rho A pi (r + h) in
/// the last step. A motion that alternates from step to step decays, however small K and dt are, if m > 2 m_a: at m = 2
/// m_a, (m + n Z dt) x^2 + (m_a + n Z dt) x - m_a has the root -1. Here m = 3 m_a.
///
/// At rest F = K (D - g) exactly. In motion the spring bears more than F, by (k - dF/dg + c/dt + m/dt^2) (g' - g), so
/// that the grip lags as if on a damper. The curve of F over g does not contain this lag.
class Frame {
 public:
  /// `strands`: their number n. `around`: length of rod around the grip [m]; 0 where the grip holds nodes. Throws
  /// InvalidInput for a stiffness that is not positive.
  Frame(double stiffness, const Material& material, int strands, double around);

  bool rigid() const;

  /// g' [m] for a displacement D' of the crosshead at the end of a step of length dt [s]. `length` l of the strands
  /// [m].
  double grip_after(double grip, double displacement, double force, double length, double dt) const;

 private:
  double stiffness_;  ///< K [N/m]
  double strands_;    ///< k times their length [N]
  double damping_;    ///< c [N s/m]
  double mass_;       ///< m [kg]
};

}  // namespace knot_utm
