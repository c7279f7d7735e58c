#pragma once

#include "knot_utm/numeric/archive.hpp"

namespace knot_utm {

/// Takes up the slack of a loop that was just put on its rollers, and stops where the loop has become taut, that is
/// where it bears a small load. This is judged after every time step, so that it does not depend on the period of the
/// commands.
///
/// The crosshead moves outwards at its speed while the loop bears next to nothing, and then at a fraction of it. A loop
/// that bears more than that load when it is put on is slackened first. Each time that the crosshead reverses it moves
/// more slowly. A force that does not fall however far the crosshead goes back does not come from the slack; the
/// crosshead then stops. It also stops where the knots slide before the load is reached.
class TakeUp {
 public:
  TakeUp() = default;
  /// `taut_load`: load of a taut loop [N]; radius of the rod [m].
  TakeUp(double taut_load, double radius) : taut_(taut_load), radius_(radius) {}

  void begin(double load, double displacement, double knot_distance);

  /// To be called after an accepted step with the same quantities as `begin`: the smaller one of the loads on the two
  /// grips [N], the displacement of the crosshead [m], and the knot distance [m].
  void follow(double load, double displacement, double knot_distance);

  /// Velocity of the crosshead, outwards positive, as a fraction of the step's speed [-].
  double velocity() const { return done_ ? 0.0 : sense_ * fraction_; }
  bool done() const { return done_; }

  void state(Archive& archive);

 private:
  double taut_ = 0.0, radius_ = 0.0;
  double sense_ = 1.0;     ///< of the motion: outwards 1, back -1
  double fraction_ = 1.0;  ///< of the speed
  double finest_ = 1.0;    ///< largest fraction from now on
  double begin_ = 0.0, knot_distance_ = 0.0;
  bool moved_ = false;  ///< since it began
  bool done_ = false;
};

}  // namespace knot_utm
