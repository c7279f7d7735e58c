#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "knot_utm/machine/break_detector.hpp"
#include "knot_utm/machine/load_control.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/ended_by.hpp"
#include "knot_utm/record/program.hpp"

namespace knot_utm {

struct Sample;

/// The test program as a state machine: it gets samples and gives commands, and depends on nothing else.
///
/// Commands come at a fixed period, 1/(k f) with f the cell's sampling rate and k the smallest whole number for
/// which the period is no longer than `longest_period`; every k-th command is a sampling instant of the cell. Command
/// n has time n/(k f), computed from whole numbers. Command 0 has time 0, phase idle and step -1: it asks for the
/// reading before anything moves. The first step begins with command 1.
///
/// What the crosshead does in each step, and what ends it:
///   tie, release  stands still, until the bench answers kPhaseDone or kNotEquilibrated
///   mount         moves outwards at `speed` until the bench answers kPhaseDone
///   preload       moves outwards at `speed`, or so that the load grows at `load_rate`, until the load is `load`; then
///                 balances, standing still for one command, if `balance` says so
///   balance       stands still for one command, which has `balance` set
///   pull          moves outwards at `speed`, or so that the load grows at `load_rate`, until the first sample that
///                 meets one of `until`; an extension may be passed by what one period moves
///   hold          for `duration`, rounded up to whole periods: stands still, or keeps a load
///   cycle         out to the upper turning point, in to the lower one, and so on at `speed`; ends with the last of
///                 `cycles`, or by `until.time`
///   return        moves inwards at `speed` until the extension is `return_extension`, or the load `until.load`
///   follow        repeats the motion of a record from its present place, until the record ends
/// Loads are true balanced forces (balanced_load), not readings. LoadControl keeps, follows and meets them with a
/// crosshead that is never faster than `speed`. A load is met within 0.1 % of it (of the range of a cycle), unless the
/// specimen stiffens within one command. Where the crosshead could not keep up with a rate of load, the rate goes on
/// from there. Extensions at which a cycle turns or a return ends are met exactly; on a compliant frame, within a
/// thousandth of the motion in one period.
///
/// The test ends when the last step has ended. It ends earlier if the rod parts, the load falls as Limits::breaks says
/// (judged in preload, pull, hold and on the outward half of a cycle), the bench fails, a true force or a reading
/// exceeds Limits::load, the crosshead reaches the end of its travel, the grips meet, or by the time limit or the
/// operator. It also ends if the knot comes undone before the first step that pulls it, once three answers in a row say
/// so. A program that neither mounts nor pulls is not ended by that, so that the knot can be watched.
class ProgramRunner {
 public:
  struct Limits {
    double load = 50e3;                                     ///< ends the test: the cell's capacity, or less [N]
    double travel = 1.0;                                    ///< ends the test: |displacement| [m]
    double least_distance = 0.0;                            ///< ends the test: the grips are nearer than that [m]
    double time = std::numeric_limits<double>::infinity();  ///< ends the test [s]
    BreakDetection breaks;
  };

  /// Sampling rate [Hz], longest period [s]. Throws std::invalid_argument for an empty program, or for a rate or period
  /// that is not positive.
  ProgramRunner(Program program, double sampling_rate, double longest_period, Limits limits);

  Command last() const { return last_; }  ///< the command that waits for its answer; at first command 0

  /// The next command after `sample`, the answer to the last command. Once the test has ended, the last command again
  /// with phase done. Throws std::invalid_argument for the answer to another command.
  Command next(const Sample& sample);

  void stop();     ///< operator: the test ends now
  void balance();  ///< operator: the next command balances
  /// The bench is lost: the test has ended by the solver, whatever command came before.
  void fail(std::string why);

  bool ended() const { return ended_by_ != EndedBy::kNotYet; }
  EndedBy ended_by() const { return ended_by_; }
  /// Whether the test failed: the simulation gave up, the knot came undone before it was pulled, or the rod parted
  /// before it was loaded.
  bool failed() const;
  /// How the reason ends where a rod parted before it was loaded.
  static constexpr const char* kTooEarly = ", before it was pulled";
  const std::string& reason() const { return reason_; }  ///< one line where the test did not end as programmed

  Phase phase() const;       ///< of the last command; done once the test has ended
  double period() const;     ///< of commands [s]
  double progress() const;   ///< 0..1, fraction of the programmed time that has passed, estimated
  double time_left() const;  ///< programmed time that is left [s], estimated

  void state(Archive& archive);

 private:
  const ProgramStep& step() const { return program_[step_]; }
  double seconds(std::uint64_t commands) const;  ///< duration of that many commands [s]
  double estimated_duration(const ProgramStep& step) const;
  void end(EndedBy by, std::string reason);
  bool end_by_alarm(const Sample& sample);
  bool only_ties() const;
  bool was_pulled() const;
  bool parts_too_early() const;
  bool is_undone(const Sample& sample) const;
  std::string break_seen(const Sample& sample);
  EndedBy step_end(const Sample& sample);  ///< kNotYet: the step goes on
  bool cycles_over(const Sample& sample);
  bool reached(double load, double target, double sense, double tolerance) const;
  void take_balance(const Sample& sample);
  void begin_step(const Sample& sample);
  void begin_leg(const Sample& sample, double velocity);
  void steer(const Sample& sample);
  double velocity_to_extension(double left) const;
  double velocity_of_cycle(const Sample& sample);
  double velocity_at_load_rate(const Sample& sample);
  double met_extension() const;
  void learn_gain(const Sample& sample);
  double recorded_way(double time) const;
  Command command(std::uint64_t sequence) const;

  Program program_;
  Limits limits_;
  std::uint64_t commands_per_reading_ = 1;
  double command_rate_ = 1.0;  ///< k f [Hz]

  std::size_t step_ = 0;
  std::uint64_t step_begin_ = 0;  ///< the last command before the step
  double step_begin_load_ = 0.0;  ///< [N]
  double wanted_load_ = 0.0;      ///< load to be kept, or followed at a rate [N]
  bool balancing_ = false;        ///< preload: reached, and now balanced
  double balance_offset_ = 0.0;   ///< of the last sample [N]
  int undone_answers_ = 0;        ///< answers in a row that say the knot is undone, before the pull
  /// Ratio of the growth of the extension to that of the displacement in the last command that moved; 1 on a rigid
  /// frame.
  struct {
    double extension = 0.0, displacement = 0.0;  ///< of the last sample [m]
    double value = 1.0;
  } gain_;
  /// A piece of a step in which the crosshead moves at one speed.
  struct {
    std::uint64_t begin = 0;    ///< the last command before it
    double displacement = 0.0;  ///< then [m]
    double velocity = 0.0;      ///< [m/s]
  } leg_;
  bool outwards_ = true;  ///< cycle: on the way to the upper turning point
  int turns_ = 0;         ///< cycle: so far
  LoadControl load_control_;
  BreakDetector break_detector_;
  Command last_;
  bool balance_next_ = false;
  EndedBy ended_by_ = EndedBy::kNotYet;
  std::string reason_;
};

}  // namespace knot_utm
