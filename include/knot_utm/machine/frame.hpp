#pragma once

#include "knot_utm/machine/options.hpp"
#include "knot_utm/rod/material.hpp"

namespace knot_utm {

/// The machine's frame, load train and crosshead drive as one spring of stiffness K [N/m] between the crosshead, which
/// travels D, and the upper grip, which moves by g less: F = K (D - g) at rest, F the force of the specimen on the
/// grip.
///
/// A step of length dt moves the grip from g to g' such that
///
///     K (D' - g') = F + (k + c/dt + m/dt^2) (g' - g)        F at the beginning of the step
///
/// Strands resist a motion of their grip by no more than k + Z/dt: k, their stiffness once taut, between the grip and
/// what else holds them, and the wave that the grip sends along each, Z = sqrt(k_s rho A). The right-hand side is thus
/// no less than F at the end of the step, and the grip comes to its place from one side, whatever K and dt are.
/// c = Z + K tau; tau stands for the inertia of crosshead and grip, without which a rod that snaps would whip them
/// about.
///
/// On a roller the rod around it moves along, and F has the inertia of its mass m_a = rho A pi (r + h): as much as the
/// last step sped it up, which in that sense is no measure of the next one. A motion to and fro from step to step dies
/// away, however small K and dt are, where m > 2 m_a (the root -1 of (m + Z dt) x^2 + (m_a + Z dt) x - m_a); m = 3 m_a.
///
/// At rest F = K (D - g) exactly. In motion the spring bears more than F, (k - dF/dg + c/dt + m/dt^2) (g' - g) of it:
/// the grip lags like one on a damper. The curve of F over g does not know of it.
class Frame {
 public:
  /// `strands` of the material side by side, which goes around the grip by `around` [m]: 0 where the grip holds it.
  /// Throws InvalidInput for a stiffness that is not positive.
  Frame(double stiffness, const Material& material, int strands, double around);

  bool rigid() const;

  /// g' [m] for a displacement D' of the crosshead at the end of a step of length dt [s]. `length` [m] of the strands:
  /// from the grip to what else holds them.
  double grip_after(double grip, double displacement, double force, double length, double dt) const;

 private:
  double stiffness_;  ///< K [N/m]
  double strands_;    ///< k times their length [N]
  double damping_;    ///< c [N s/m]
  double mass_;       ///< m [kg]
};

}  // namespace knot_utm
