#pragma once

namespace knot_utm {

class Archive;
struct Material;

/// The machine's frame, load train and crosshead drive as one spring of stiffness K [N/m] between the crosshead, which
/// travels D, and the upper grip, which moves by g less: F = K (D - g) at rest, F the force of the specimen on the grip
/// (doc/model.md, section 6).
///
/// A step of length dt moves the grip from g to g' such that
///
///     K (D' - g') = F + (k + n Z/dt + K tau/dt + m/dt^2) (g' - g)        F at the beginning of the step
///
///   k    present stiffness of the specimen, from the last steps; at most n k_s/l, that of n taut strands of length l
///   Z    (k_s (rho A + c dt))^1/2, impedance of the wave that the grip sends along each strand, with drag c [N s/m^2]
///   tau  stands for the inertia of crosshead and grip, without which they would oscillate when a rod snaps
///   m    3 m_a, with m_a the mass of the rod around a roller or in a clamp, whose inertia force of the last step is
///   part
///        of F: with m <= 2 m_a a motion that alternates from step to step would not decay, as at m = 2 m_a
///        (m + n Z dt) x^2 + (m_a + n Z dt) x - m_a has the root -1
///
/// In motion the grip lags a little, as if on a damper; the curve of F over g does not contain this lag. Where F
/// stiffens at once, passed_balance asks for shorter steps.
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
  /// Force that the specimen gains until the grip is at rest, once the crosshead stands at D [N].
  double still_to_come(double grip, double displacement, double force, double length) const;
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
