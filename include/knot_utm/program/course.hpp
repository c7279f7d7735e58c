#pragma once

#include <cstdint>
#include <limits>

#include "knot_utm/record/command.hpp"

namespace knot_utm {

struct Sample;

/// Controls the crosshead by the load. It knows what a testing machine knows: loads and displacements so far.
///
/// Following a course of the load:
///
///   v = (F_wanted - F)/(k T), |v| <= v_max,    k <- max(dF/dx, k/2)
///
/// with F the present load, F_wanted that of the next command, T the period of commands, and k [N/m] the specimen's
/// stiffness from the last command that moved, dF/dx. k rises at once and falls at most by half, so that the load does
/// not overshoot where the specimen becomes stiff, and catches up where it becomes soft. Before anything has moved the
/// speed is a hundredth of v_max.
///
/// Going to a load: v_max, but no further than to where the slope of the last command predicts the load.
class LoadControl {
 public:
  /// Begins without knowledge of the stiffness.
  void begin() { *this = LoadControl(); }

  /// Speed of the crosshead until the next command, outwards positive [m/s].
  double following(const Sample& now, double wanted_load, double period, double fastest);

  /// Magnitude of the speed towards a load [m/s]. `creeps`: go slowly as long as no slope is known.
  double meeting(const Sample& now, double wanted_load, double period, double fastest, bool creeps);

  /// Takes account of a new zero of the load [N].
  void shift(double load) { last_load_ -= load; }

 private:
  void learn(const Sample& now, double counting_distance);

  bool knows_last_ = false, knows_slope_ = false;
  double last_load_ = 0.0, last_displacement_ = 0.0;
  double slope_ = 0.0;      // dF/dx of the last command that moved [N/m]
  double stiffness_ = 0.0;  // k [N/m]
};

inline constexpr double kLoadTolerance = 1e-3;  // within which a load is reached [of it]
inline constexpr double kTurnTolerance = 1e-9;  // within which a turn is reached [rad]

/// Whether a value has risen (sense 1) or fallen (-1) to its target.
inline bool reached(double value, double target, double sense, double tolerance) {
  return sense * (value - target) >= -tolerance;
}

/// The motion of the crosshead and the upper clamp through a program. It consists of legs with one velocity each. The
/// steps of the program begin its legs, and read from it how far the test is.
class CrossheadCourse {
 public:
  /// `command_rate` [Hz]. `most_load` [N], `most_travel` [m]: limits that end the test.
  explicit CrossheadCourse(double command_rate = 1.0, double most_load = 0.0, double most_travel = 0.0)
      : command_rate_(command_rate), most_load_(most_load), most_travel_(most_travel) {}

  double period() const { return 1.0 / command_rate_; }  ///< of commands [s]
  double most_load() const { return most_load_; }
  double most_travel() const { return most_travel_; }
  const Command& last() const { return last_; }
  double velocity() const { return leg_.velocity; }
  double begin_load() const { return begin_load_; }  ///< as the step began [N]
  double begin_turn() const { return begin_turn_; }  ///< as the step began [rad]

  /// Time from the beginning of the step to the last command, or to `more` commands after it [s].
  double time(std::uint64_t more = 0) const { return seconds(last_.sequence + more - begin_); }
  /// Whether this time [s], rounded up to whole periods, has passed since the step began.
  bool over(double time) const;

  /// Begins a leg with this velocity. Places are computed from the beginning of the leg, so that rounding does not add
  /// up.
  void move(double velocity);
  /// Turns the upper clamp from where it is, at this rate [rad/s].
  void turn(double rate) { turn_leg_ = {last_.sequence, last_.turn, rate}; }
  void balance() { balance_next_ = true; }  ///< with the next command

  /// Velocity towards an extension that is `left` [m] away; it does not lead beyond it within one period.
  double velocity_to_extension(double left, double fastest) const;
  /// Distance from an extension within which it is reached [m].
  double extension_tolerance(double fastest) const;
  /// Magnitude of the velocity towards a load, at which the crosshead stops. `creeps`: go slowly as long as no slope is
  /// known.
  double speed_to_load(const Sample& now, double load, double fastest, bool creeps);
  /// The load that velocity_at_load() keeps from now on [N]; at first that at the beginning of the step.
  void keep_load(double load) { wanted_load_ = load; }
  double velocity_at_load(const Sample& now, double fastest);
  /// Velocity with which the load grows at a rate [N/s], and then stays at `end` [N]. If the crosshead is at its
  /// highest speed and the load lags behind, it goes on from the present load: what counts is the rate, not a time
  /// table. The crosshead stops at `end`.
  double velocity_at_load_rate(const Sample& now, double rate, double fastest,
                               double end = std::numeric_limits<double>::infinity());
  /// Forgets the stiffness of the specimen, which is another one after a turning point.
  void forget_stiffness() { load_control_.begin(); }

  // For the runner of the program.
  void begin_step(const Sample& now);
  /// Takes account of a sample, before which the crosshead may have stopped or moved by itself. Loads that are
  /// remembered are converted to its zero; returns whether that has moved.
  bool take(const Sample& now);
  /// Writes velocity, displacement and turn of the present leg at the time of `command` into it, and the load at which
  /// the crosshead stops: that to which it goes, but none beyond the most.
  void write_motion(Command& command) const;
  void accept(const Command& command);
  double seconds(std::uint64_t commands) const { return static_cast<double>(commands) / command_rate_; }

 private:
  static constexpr double kNoLoad = std::numeric_limits<double>::quiet_NaN();

  double command_rate_, most_load_, most_travel_;
  Command last_;
  std::uint64_t begin_ = 0;  // the last command before the step
  double begin_load_ = 0.0, begin_turn_ = 0.0;
  double wanted_load_ = 0.0;     // that is kept, or grows at a rate [N]
  double end_load_ = kNoLoad;    // to which the crosshead goes [N]
  double balance_offset_ = 0.0;  // of the last sample [N]
  bool balance_next_ = false;
  // Growth of the extension over that of the displacement in the last command that moved; 1 on a rigid frame.
  struct {
    double extension = 0.0, displacement = 0.0;  // of the last sample [m]
    double value = 1.0;
  } gain_;
  struct {
    std::uint64_t begin = 0;    // the last command before it
    double displacement = 0.0;  // then [m]
    double velocity = 0.0;      // [m/s]
  } leg_;
  struct {
    std::uint64_t begin = 0;  // the last command before it
    double turn = 0.0;        // then [rad]
    double rate = 0.0;        // [rad/s]
  } turn_leg_;
  LoadControl load_control_;
};

}  // namespace knot_utm
