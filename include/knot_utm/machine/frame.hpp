#pragma once

#include "knot_utm/specimen/machine_options.hpp"

namespace knot_utm {

class Archive;
struct Material;

/// The machine's frame, load train and crosshead drive as one spring of stiffness K [N/m] between the crosshead, which
/// travels D, and the upper grip, which moves by g less: F = K (D - g) at rest, F the force of the specimen on the
/// grip.
///
/// A step of length dt moves the grip from g to g' such that
///
///     K (D' - g') = F + (k + n Z/dt + K tau/dt + m/dt^2) (g' - g)        F at the beginning of the step
///
/// k is the specimen's present stiffness. It is what F gained over the motion of the grip in the last step, or half of
/// the k before where that is more, so that it rises at once and falls within some steps; never below zero, and never
/// above n k_s/l, that of n taut strands of the length l from the grip to what else holds them, with which it begins.
/// Z = sqrt(k_s (rho A + c dt)) is the impedance of what the grip sends along each strand within the step: a wave,
/// which the drag c [N s/m^2] of the step slows down. tau stands for the inertia of crosshead and grip, without which
/// they would whip to and fro when a rod snaps. F has the drag and inertia of the step before; without n Z the grip
/// would answer to them by a motion that grows from step to step.
///
/// The rod around a roller, or in a clamp, moves with it, so that F contains the inertia force of its mass m_a in the
/// last step. A motion that alternates from step to step decays, however small K and dt are, if m > 2 m_a: at m = 2
/// m_a, (m + n Z dt) x^2 + (m_a + n Z dt) x - m_a has the root -1. Here m = 3 m_a; the drag of that length is a part of
/// m_a, as c dt is of rho A.
///
/// At rest F = K (D - g) exactly. In motion the spring bears more than F, by (k - dF/dg + (n Z + K tau)/dt + m/dt^2)
/// (g' - g), so that the grip lags as if on a damper: a little, as k follows dF/dg. Where F stiffens at once,
/// passed_balance asks for shorter steps. The curve of F over g does not contain this lag.
class Frame {
 public:
  /// `strands`: their number n. `moved`: length of rod that moves with the grip, m_a/(rho A) [m].
  Frame(double stiffness, const Material& material, int strands, double moved);

  bool rigid() const;

  /// g' [m] for a displacement D' of the crosshead at the end of a step of length dt [s]. `length` l of the strands
  /// [m], `drag` c.
  double grip_after(double grip, double displacement, double force, double length, double dt, double drag) const;
  /// Whether a step that was solved moved the grip by `moved` to where the specimen bears more than the frame, by more
  /// than a tenth of it and `least` [N]: it stiffened within the step, which is to be tried again in shorter ones.
  /// Never in steps so short that a wave along taut strands bears all that the grip can gain.
  bool passed_balance(double moved, double grip, double displacement, double force, double length, double dt,
                      double drag, double least) const;
  /// After an accepted step that moved the grip by `moved` [m] and changed its force by `gained` [N].
  void follow(double moved, double gained, double length);

  void state(Archive& archive);

 private:
  /// n Z/dt + K tau/dt + m/dt^2 [N/m]
  double resistance(double dt, double drag) const;

  double stiffness_;           ///< K [N/m]
  double strands_ = 0.0;       ///< n k_s [N]
  double specimen_;            ///< k, unless taut strands are softer [N/m]
  double line_density_ = 0.0;  ///< rho A [kg/m]
  double number_;              ///< n
  double moved_;               ///< m_a/(rho A) [m]
};

}  // namespace knot_utm
