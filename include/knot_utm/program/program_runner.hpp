#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "knot_utm/program/course.hpp"
#include "knot_utm/program/program.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/ended_by.hpp"

namespace knot_utm {

struct Sample;

/// When a testing machine detects a break: the load has fallen to a fraction of its peak. Only loads count; a rod that
/// parts in the simulation (break_watch.hpp) ends the test in any case.
struct BreakDetection {
  std::optional<double> fraction_of_peak;  ///< [-]; unset: no fall is a break
  double arming_load = 0.0;                ///< falls count only after the load has reached this [N]
};

/// Watches the load while the crosshead moves outwards. It uses the largest and the smallest load over all time steps
/// of a command (Sample::highest_load, lowest_load) and not the cell's readings, so that it sees a drop between two
/// readings.
class BreakDetector {
 public:
  explicit BreakDetector(const BreakDetection& detection) : detection_(detection) {}

  void begin() { peak_ = 0.0; }  ///< begins a motion outwards

  /// Takes the next sample. Returns a message about the break that it shows; empty: none.
  std::string judge(const Sample& sample);

 private:
  BreakDetection detection_;
  double peak_ = 0.0;  // [N]
};

/// Where an operator sends the crosshead: to an extension or a load, out or in, whichever it reaches first. Neither of
/// them: back until one of them is 0.
struct CrossheadMove {
  double extension = 0.0;  ///< s; 0: none [m]
  double load = 0.0;       ///< balanced; 0: none [N]
  double speed = 0.0;      ///< 0: that of the program's first pull [m/s]
};

/// The test program as a state machine: it gets samples and gives commands, and depends on nothing else.
///
/// Commands come at a fixed period, 1/(k f) with f the cell's sampling rate and k the smallest whole number for
/// which the period is no longer than `longest_period`; every k-th command is a sampling instant of the cell. Command
/// n has time n/(k f), computed from whole numbers. Command 0 has time 0, phase idle and step -1: it asks for the
/// reading before anything moves. The first step begins with command 1.
///
/// Each step says what the crosshead does in it, and when it ends (program/program.hpp).
/// Loads are true balanced forces (balanced_load), not readings. LoadControl keeps, follows and meets them with a
/// crosshead that is never faster than `speed`. A load is met within 0.1 % of it (of the range of a cycle): where the
/// specimen stiffens within one command, the crosshead stops there (Command::stop_load).
///
/// The test ends when the last step has ended. It ends earlier if the rod parts, the load falls as Limits::breaks says
/// (judged in steps that can break, while the crosshead does not return), the bench fails, a true force or a reading
/// exceeds Limits::load, the crosshead reaches the end of its travel, the grips meet, or by the time limit or the
/// operator. It also ends if three answers in a row say that the knot came undone before the first step that pulls it,
/// unless the program never moves the crosshead: the knot is then watched.
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

  Command last() const { return course_.last(); }  ///< the command that waits for its answer; at first command 0

  /// The next command after `sample`, the answer to the last command. Once the test has ended, the last command again
  /// with phase done. Throws std::invalid_argument for the answer to another command.
  Command next(const Sample& sample);

  void stop() { end(EndedBy::kOperator, "stopped by the operator"); }  ///< the test ends now
  void balance() { course_.balance(); }                                ///< by the operator: the next command balances
  /// By the operator: the crosshead goes there once the specimen is prepared, in place of what is left of the program.
  void lead(const CrossheadMove& move) { move_ = move; }
  /// By the operator: the crosshead stands. False: it was not being led, and the program goes on.
  bool stand();
  /// The crosshead stands where it was led. The program gives no command before it is led again or stopped.
  bool waits() const { return waits_ && !move_ && !ended(); }
  EndedBy led_by() const { return led_by_; }  ///< what it reached; kOperator: it was to stand
  /// The plateau of the pull is settled: the test ends now, which is no failure. `where`: one line about it.
  void plateau_settled(std::string where) { end(EndedBy::kPlateau, std::move(where)); }
  /// The machine is lost: the test has ended by the solver, whatever command came before.
  void fail(std::string why);

  bool ended() const { return ended_by_ != EndedBy::kNotYet; }
  EndedBy ended_by() const { return ended_by_; }
  /// Whether the test failed: the simulation gave up, the knot came undone before it was pulled, or the rod parted
  /// before it was loaded.
  bool failed() const;
  /// How the reason ends where a rod parted before it was loaded.
  static constexpr const char* kTooEarly = ", before it was pulled";
  const std::string& reason() const { return reason_; }  ///< one line where the test did not end as programmed

  /// Of the last command; done once the test has ended.
  Phase phase() const { return ended() ? Phase::kDone : last().phase; }
  double period() const { return course_.period(); }  ///< of commands [s]
  double progress() const;                            ///< 0..1, fraction of the programmed time that has passed
  double time_left() const;                           ///< programmed time that is left, estimated [s]

 private:
  void end(EndedBy by, std::string reason);
  bool begin_next_step(EndedBy by, const Sample& sample);
  bool may_lead_from(std::size_t step) const;
  void lead_from(std::size_t step, const Sample& sample);
  bool end_by_alarm(const Sample& sample);
  bool only_ties() const;
  bool parts_too_early() const;
  bool is_undone(const Sample& sample) const;
  std::string break_seen(const Sample& sample);
  Command command(std::uint64_t sequence) const;

  Program program_;
  Limits limits_;
  std::uint64_t commands_per_reading_ = 1;
  std::size_t step_ = 0;
  int undone_answers_ = 0;  ///< answers in a row that say the knot is undone, before the pull
  CrossheadCourse course_;
  BreakDetector break_detector_;
  EndedBy ended_by_ = EndedBy::kNotYet;
  std::string reason_;
  std::optional<CrossheadMove> move_;  ///< that is to begin
  double pull_speed_;                  ///< [m/s]
  bool led_ = false;                   ///< a move was the last to begin
  bool stands_ = false;                ///< it is to end
  bool waits_ = false;                 ///< it has ended
  EndedBy led_by_ = EndedBy::kNotYet;
};

/// Runs a whole test, or the rest of one: exchanges commands and samples with the bench until the test has ended.
/// `observe(command, sample)` sees each answer before the program does and may call `program.stop()`. `interrupted()`
/// may end the run between commands, when bench and program can be saved and continued later. A Bench has `Sample
/// respond(const Command&)`.
template <class Bench, class Observer, class Interrupted>
void run_test(Bench& bench, ProgramRunner& program, Observer observe, Interrupted interrupted) {
  Command command = program.last();
  while (!program.ended() && !interrupted()) {
    const auto sample = bench.respond(command);
    observe(command, sample);
    command = program.next(sample);
  }
}
template <class Bench, class Observer>
void run_test(Bench& bench, ProgramRunner& program, Observer observe) {
  run_test(bench, program, observe, [] { return false; });
}

}  // namespace knot_utm
