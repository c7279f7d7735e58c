#pragma once

#include <string>
#include <vector>

#include "knot_utm/machine/grips.hpp"
#include "knot_utm/machine/knot_touch.hpp"
#include "knot_utm/machine/take_up.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/specimen/tying_rig.hpp"

namespace knot_utm {

/// A loop on the machine, and its two knots: the rig ties them and lets them go, the loop is put on the grips and its
/// slack is taken up, and what is said of two knots is read. A loop whose program ties nothing has an idle rig, and its
/// knots are read all the same.
class TiedLoop {
 public:
  /// `creep_speed`: at which nodes of a rod at rest may still move, by its friction [m/s]. What it is made with must
  /// outlive it. The centreline has two knots.
  TiedLoop(const SpecimenOptions& specimen, const Material& material, const Centreline& centreline, double creep_speed,
           TimeStep& stepper, Grips& grips);

  /// Where the crosshead and the upper grip are, and when.
  struct Place {
    double time;          ///< [s]
    double displacement;  ///< of the crosshead [m]
    double grip;          ///< of the upper grip [m]
  };

  /// Before the first command of a step of the program.
  void enter(const Command& command, const Place& now);
  /// After an accepted step, which took `dt` [s].
  void follow(Phase phase, const Place& now, double dt);
  /// After a command: what the program no longer holds is let go.
  void leave(Phase phase, const Place& now);

  /// Holds and bears the rod as the rig does at `to` instead of what the grips have put into the boundary.
  void hold(Boundary& boundary, double from, double to) const;
  double left_to_put_on(double time) const { return rig_.left_to_put_on(time); }

  /// Of the strands below the upper grip, as far as the lower one or the rig's clamps, as mounted [m].
  double held_length(double from, double to) const;

  /// While it is mounted the crosshead takes up the slack by itself, no faster than at `speed`: its velocity [m/s].
  double mounting_velocity(double speed) const;

  /// Whether a step that ends by itself has come to its end: the loop is tied, released or mounted.
  bool done(Phase phase) const;
  const std::string& not_tied() const { return rig_.not_tied(); }
  const std::string& not_equilibrated() const { return rig_.not_equilibrated(); }

  /// As KnotWatch takes them.
  std::vector<int> standing_nodes() const { return rig_.standing_nodes(); }

  /// What a sample has of knots: that of each, and that of the two.
  void read(Sample& sample) const;

  void state(Archive& archive);

 private:
  void put_on(const Place& now);
  void begin_to_take_up(const Place& now);
  double load_on_both() const;
  double knot_distance() const;

  TimeStep& stepper_;
  Grips& grips_;
  double radius_, bending_set_;
  TyingRig rig_;
  KnotTouch touch_;
  TakeUp take_up_;
};

}  // namespace knot_utm
