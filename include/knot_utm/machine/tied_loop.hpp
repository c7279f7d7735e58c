#pragma once

#include <string>
#include <vector>

#include "knot_utm/machine/grips.hpp"
#include "knot_utm/machine/knot_touch.hpp"
#include "knot_utm/machine/take_up.hpp"
#include "knot_utm/record/phase.hpp"
#include "knot_utm/specimen/tying_rig.hpp"

namespace knot_utm {

struct Command;
struct Material;
struct Sample;

/// A loop on the machine with its two knots. The rig ties and releases them, the loop is put on the grips, its slack is
/// taken up, and the knots are read. Where the program ties nothing, the rig is idle, and the knots are read as well.
class TiedLoop {
 public:
  /// `creep_speed`: speed with which nodes of a rod at rest may creep under its friction [m/s]. `stepper` and `grips`
  /// must outlive this object. The centreline has two knots.
  TiedLoop(const SpecimenOptions& specimen, const Material& material, const Centreline& centreline, double creep_speed,
           TimeStep& stepper, Grips& grips);

  /// Places of the crosshead and the upper grip at a time.
  struct Place {
    double time;          ///< [s]
    double displacement;  ///< of the crosshead [m]
    double grip;          ///< of the upper grip [m]
  };

  /// To be called before the first command of a step of the program.
  void enter(const Command& command, const Place& now);
  /// To be called after an accepted time step of length `dt` [s].
  void follow(Phase phase, const Place& now, double dt);
  /// To be called after a command: releases what the program no longer holds.
  void leave(Phase phase, const Place& now);

  /// Replaces the holders that the grips have put into the boundary by those of the rig at time `to` [s].
  void hold(Boundary& boundary, double from, double to) const;
  double left_to_put_on(double time) const { return rig_.left_to_put_on(time); }
  /// Fraction of its weight that a loop has at a time: none off the rollers, and all of it once they have taken it.
  double weight_borne(double time) const { return rig_.off_rollers() ? 0.0 : 1.0 - rig_.left_to_put_on(time); }

  /// Length of the strands from the upper grip to the lower one, or to the rig's clamps, as mounted [m].
  double held_length(double from, double to) const;

  /// Velocity of the crosshead while it takes up the slack of mounting, at most `speed` [m/s].
  double mounting_velocity(double speed) const;

  /// Whether a phase that ends by itself has ended: the loop is tied, released or mounted.
  bool done(Phase phase) const;
  /// Why the loop cannot be tied or mounted; empty: it can.
  const std::string& gave_up() const { return not_mounted_.empty() ? rig_.not_tied() : not_mounted_; }
  const std::string& not_equilibrated() const { return rig_.not_equilibrated(); }

  /// For KnotWatch.
  std::vector<int> standing_nodes() const { return rig_.standing_nodes(); }

  /// Fills the fields of a sample that concern the knots.
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
  std::string not_mounted_;
};

}  // namespace knot_utm
