#pragma once

#include "knot_utm/numeric/archive.hpp"

namespace knot_utm {

/// Takes up the slack of a loop that was just put on its rollers, and stops where it has become taut: where it bears a
/// small load. That is found from time step to time step, so that it does not depend on the period of the commands.
///
/// The crosshead goes outwards at its speed while the loop bears next to nothing, and at a fraction of it from there
/// on. A loop that bears more, for it was taut already when it was put on, is slackened first; each time that the
/// crosshead turns it goes more slowly. What pushes the rollers apart however far it goes back is not the slack's: it
/// then stands. So it does where the knots slide before the load is there.
class TakeUp {
 public:
  TakeUp() = default;
  /// A taut loop bears this [N]; radius of the rod [m].
  TakeUp(double taut_load, double radius) : taut_(taut_load), radius_(radius) {}

  void begin(double load, double displacement, double knot_distance);

  /// After an accepted step, as when it begins: the smaller one of the loads on the two grips [N], where the crosshead
  /// is [m], how far the knots are apart [m].
  void follow(double load, double displacement, double knot_distance);

  /// Of the crosshead, outwards, in the step's own speed.
  double velocity() const { return done_ ? 0.0 : sense_ * fraction_; }
  bool done() const { return done_; }

  void state(Archive& archive);

 private:
  double taut_ = 0.0, radius_ = 0.0;
  double sense_ = 1.0;     ///< of the way: outwards 1, back -1
  double fraction_ = 1.0;  ///< of the speed
  double finest_ = 1.0;    ///< largest fraction from now on
  double begin_ = 0.0, knot_distance_ = 0.0;
  bool moved_ = false;  ///< since it began
  bool done_ = false;
};

}  // namespace knot_utm
