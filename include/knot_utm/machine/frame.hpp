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
///     K (D' - g') = F + (k + c/dt) (g' - g)        F at the beginning of the step
///
/// The specimen resists a motion of its grip by no more than k + Z/dt: k, its rod's stiffness once taut, and the wave
/// that the grip sends into it, Z = sqrt(k_s rho A) for each strand. The right-hand side is thus no less than F at the
/// end of the step, and the grip comes to its place from one side, whatever K and dt are. c = Z + K tau; tau stands for
/// the inertia of crosshead and grip, without which a rod that snaps would whip them about.
///
/// At rest F = K (D - g) exactly. In motion the spring bears more than F, (k - dF/dg + c/dt) (g' - g) of it: the grip
/// lags like one on a damper. The curve of F over g does not know of it.
class Frame {
 public:
  /// `strands` of the material side by side, of `length` [m] between the grips. Throws InvalidInput for a stiffness
  /// that is not positive.
  Frame(double stiffness, const Material& material, int strands, double length);

  bool rigid() const;

  /// g' [m] for a displacement D' of the crosshead at the end of a step of length dt [s].
  double grip_after(double grip, double displacement, double force, double dt) const;

 private:
  double stiffness_;  ///< K [N/m]
  double specimen_;   ///< k [N/m]
  double damping_;    ///< c [N s/m]
};

}  // namespace knot_utm
