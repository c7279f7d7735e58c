#pragma once

#include <cstdint>
#include <limits>

#include "knot_utm/record/command.hpp"

namespace knot_utm {

struct Sample;

/// Moves the crosshead by the load. It uses only what a testing machine knows: the loads and displacements so far.
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
/// Meeting a load: v_max, but no further than to where the load lies by the slope of the last command.
class LoadControl {
 public:
  /// Begins without knowledge of the stiffness.
  void begin() { *this = LoadControl(); }

  /// Speed of the crosshead until the next command, outwards positive [m/s].
  double following(const Sample& now, double wanted_load, double period, double fastest);

  /// Magnitude of the speed towards a load [m/s]. `creeps`: slowly as long as no slope is known.
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

inline constexpr double kMetLoad = 1e-3;  // nearer to a load it is met [of it]
inline constexpr double kMetTurn = 1e-9;  // nearer to a turn it is met [rad]

/// Whether a value rose (sense 1) or fell (-1) to its target.
inline bool reached(double value, double target, double sense, double tolerance) {
  return sense * (value - target) >= -tolerance;
}

/// The course of the crosshead through a program. It consists of legs, in each of which the crosshead moves at one
/// speed. The steps of the program ask it how far the test is, and lead it.
class CrossheadCourse {
 public:
  /// `command_rate`: of commands [Hz]. `most_load`, `most_travel`: they end the test [N], [m].
  explicit CrossheadCourse(double command_rate = 1.0, double most_load = 0.0, double most_travel = 0.0)
      : command_rate_(command_rate), most_load_(most_load), most_travel_(most_travel) {}

  double period() const { return 1.0 / command_rate_; }  ///< of commands [s]
  double most_load() const { return most_load_; }
  double most_travel() const { return most_travel_; }
  const Command& last() const { return last_; }
  double velocity() const { return leg_.velocity; }
  double begin_load() const { return begin_load_; }  ///< as the step began [N]
  double begin_turn() const { return begin_turn_; }  ///< as the step began [rad]

  /// The time since the step began, as it will be `more` commands from now [s].
  double time(std::uint64_t more = 0) const { return seconds(last_.sequence + more - begin_); }
  /// Whether so much time has passed since the step began, rounded up to whole periods.
  bool over(double time) const;

  /// Begins a leg. Every leg counts from its own beginning, so that rounding does not add up.
  void move(const Sample& now, double velocity);
  /// Turns the upper clamp from where it is, at this rate [rad/s].
  void turn(double rate) { turn_leg_ = {last_.sequence, last_.turn, rate}; }
  void balance() { balance_next_ = true; }  ///< The next command balances.

  /// Velocity towards an extension that is `left` [m] away, and no further.
  double velocity_to_extension(double left, double fastest) const;
  /// How near an extension counts as met [m].
  double extension_tolerance(double fastest) const;
  /// Magnitude of the velocity towards a load. `creeps`: slowly as long as no slope is known.
  double speed_to_load(const Sample& now, double load, double fastest, bool creeps);
  /// Velocity that keeps `wanted_load`.
  double velocity_at_load(const Sample& now, double fastest);
  /// Velocity that lets `wanted_load` grow at a rate, and keeps it at `end`. Where the crosshead could go no faster the
  /// course begins anew from the present load: it is a rate, not a time table.
  double velocity_at_load_rate(const Sample& now, double rate, double fastest,
                               double end = std::numeric_limits<double>::infinity());
  double wanted_load = 0.0;                           ///< to be kept, or followed at a rate [N]
  void forget_stiffness() { load_control_.begin(); }  ///< of the specimen, as after a turn

  // For the runner of the program.
  void begin_step(const Sample& now);
  /// Takes account of a sample: what is remembered of loads is told from its zero. Returns whether that moved.
  bool take(const Sample& now);
  /// Fills in the next command's motion, or that of a command that was made before.
  void fill(Command& command) const;
  void accept(const Command& command);
  double seconds(std::uint64_t commands) const { return static_cast<double>(commands) / command_rate_; }

 private:
  double command_rate_, most_load_, most_travel_;
  Command last_;
  std::uint64_t begin_ = 0;  // the last command before the step
  double begin_load_ = 0.0, begin_turn_ = 0.0;
  double balance_offset_ = 0.0;  // of the last sample [N]
  bool balance_next_ = false;
  // Ratio of the growth of the extension to that of the displacement in the last command that moved; 1 on a rigid
  // frame.
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

struct Sample;

}  // namespace knot_utm
