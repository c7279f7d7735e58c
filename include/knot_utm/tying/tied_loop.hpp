#pragma once

#include <string>
#include <vector>

#include "knot_utm/grips/grips.hpp"
#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/program/program.hpp"
#include "knot_utm/specimen/knot_readings.hpp"
#include "knot_utm/tying/tying.hpp"
#include "knot_utm/tying/tying_rig.hpp"

namespace knot_utm {

/// Takes up the slack of a loop that was just put on its rollers, and stops once the loop is taut, that is once it
/// bears a small load. This is judged after every time step, so that it does not depend on the period of the commands.
///
/// The crosshead moves outwards at its speed while the loop bears next to nothing, and then at a fraction of the speed.
/// A loop that bears more than the taut load as it is put on is slackened first. At each reversal the crosshead becomes
/// slower. It also stops if the load does not fall however far it goes back, because the load then has another cause,
/// and if the knots slide before the loop is taut.
class TakeUpSlack {
 public:
  TakeUpSlack() = default;
  /// `taut_load`: load of a taut loop [N]; radius of the rod [m].
  TakeUpSlack(double taut_load, double radius) : taut_(taut_load), radius_(radius) {}

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

/// The knot distance e to which mounting sets the knots of a loop that the program ties [m]; 0: it does not.
double marks_of(const SpecimenOptions& specimen, const Program& program);

/// Ties and mounts a loop, and reads its two knots. The rig ties and releases the knots, the loop is put on the grips,
/// and its slack is taken up. Then the knots are set to their marks: e and L get the values of the method
/// (doc/model.md, section 9). Where the program ties nothing, the rig is idle, and the knots are read all the same.
class TiedLoop final : public Tying {
 public:
  /// `creep_speed`: speed with which nodes of a rod at rest may creep under its friction [m/s]. `stepper` and `grips`
  /// must outlive this object. The centreline has two knots.
  TiedLoop(const SpecimenOptions& specimen, const Material& material, const Centreline& centreline, double creep_speed,
           TimeStep& stepper, Grips& grips);

  void enter(const Command& command, const Place& now) override;
  void prepare(const Place& now) override;
  void follow(Phase phase, const Place& now, double dt) override;
  void leave(Phase phase, const Place& now) override;
  void hold(Boundary& boundary, double from, double to) const override;
  double extra_drag(double to) const override { return rig_.extra_drag(to); }
  double left_to_put_on(double time) const override { return rig_.left_to_put_on(time); }
  /// None before the loop is put on the rollers, and all once it is.
  double weight_borne(double time) const override {
    return rig_.has_been_put_on() ? 1.0 - rig_.left_to_put_on(time) : 0.0;
  }
  double held_length(double from, double to) const override;
  double mounting_velocity(double speed) const override;
  bool done(Phase phase) const override;
  const std::string& gave_up() const override { return not_mounted_.empty() ? rig_.not_tied() : not_mounted_; }
  const std::string& not_equilibrated() const override { return rig_.not_equilibrated(); }
  std::vector<int> standing_nodes() const override { return rig_.standing_nodes(); }
  void read(Sample& sample) const override;
  void state(Archive& archive) override;

 private:
  void put_on(const Place& now);
  bool set_to_marks(const Place& now);
  bool setting() const { return set_end_ > 0.0; }
  void follow_mounting(const Place& now, bool puts_on);
  void solve_whole_once_they_slide();
  void begin_on_slack(const Place& now);
  double load_on_both() const;
  double knot_distance() const;

  TimeStep& stepper_;
  Grips& grips_;
  double radius_;
  bool sets_to_marks_;
  double knot_distance_, end_to_end_;   // e and L with which the pull is to begin: the marks [m]
  double set_end_ = 0.0;                // time at which the present setting to the marks ends; 0: there is none [s]
  double set_speed_ = 0.0;              // of the crosshead until then [m/s]
  double apart_ = 0.0, further_ = 0.0;  // growth of e and L that is left until then [m]
  double unlaid_ = 0.0;         // length of the last step, whose part of the setting is not laid yet; 0: none [s]
  double speed_ = 0.0;          // of the step that mounts [m/s]
  double tied_distance_ = 0.0;  // e as the loop is put on [m]
  int sets_ = 0;                // number of settings so far
  double farthest_ = 0.0;       // the largest e since the pull began; 0: it has not [m]
  bool at_marks_ = false;       // the loop is taut, and e and L are as near to the marks as they come
  TyingRig rig_;
  KnotTouch touch_;
  TakeUpSlack slack_;
  std::string not_mounted_;
};

}  // namespace knot_utm
