#include "knot_utm/machine/program_runner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "knot_utm/record/sample.hpp"

namespace knot_utm {
namespace {

constexpr double kMetLoad = 1e-3;       // nearer to a load it is met [of it]
constexpr double kMetExtension = 1e-9;  // nearer to an extension it is met [m]
constexpr double kMetByAFrame = 1e-3;   // on a compliant frame [of what one period moves]
constexpr double kRigid = 1.0 - 1e-6;   // gain of a frame that gives nothing
constexpr double kLeastGain = 1e-3;     // of a frame that gives nearly all
constexpr int kUndoneAnswers = 3;       // in a row: a strand that is thrown about may be taken for another knot once

/// Whether the step puts a load on the specimen.
bool loads(const ProgramStep& step) {
  return pulls(step.phase) || step.phase == Phase::kPreload || (step.hold_load && step.held_load.value_or(0.0) > 0.0);
}

/// The velocity of the crosshead as a step begins [m/s].
double first_velocity(const ProgramStep& step) {
  switch (step.phase) {
    case Phase::kPreload:
    case Phase::kPull:
      return step.load_rate ? 0.0 : step.speed;
    case Phase::kMount:
    case Phase::kCycle:
      return step.speed;
    case Phase::kReturn:
      return -step.speed;
    default:
      return 0.0;
  }
}

}  // namespace

ProgramRunner::ProgramRunner(Program program, double sampling_rate, double longest_period, Limits limits)
    : program_(std::move(program)), limits_(limits), break_detector_(limits.breaks) {
  if (program_.empty()) throw std::invalid_argument("a test program needs a step");
  if (!(sampling_rate > 0.0) || !(longest_period > 0.0)) {
    throw std::invalid_argument("a test program needs a positive sampling rate and period");
  }
  // The slack keeps a period that is meant to be equal from being halved by rounding.
  commands_per_reading_ =
      static_cast<std::uint64_t>(std::max(1.0, std::ceil(1.0 / (sampling_rate * longest_period) - 1e-9)));
  command_rate_ = static_cast<double>(commands_per_reading_) * sampling_rate;
  last_ = command(0);
}

Command ProgramRunner::next(const Sample& sample) {
  if (ended()) return command(last_.sequence);
  if (sample.sequence != last_.sequence) {
    throw std::invalid_argument("the sample answers command " + std::to_string(sample.sequence) + ", not command " +
                                std::to_string(last_.sequence));
  }
  take_balance(sample);
  learn_gain(sample);
  undone_answers_ = is_undone(sample) ? std::min(undone_answers_ + 1, kUndoneAnswers) : 0;
  if (end_by_alarm(sample)) return command(last_.sequence);

  const EndedBy by = last_.sequence == 0 ? EndedBy::kNotYet : step_end(sample);
  if (by != EndedBy::kNotYet) {
    if (step_ + 1 == program_.size()) {
      // What only ties has done what it is for; that the knot is gone is how it ended all the same.
      end(is_undone(sample) ? EndedBy::kUntangled : by, "");
      return command(last_.sequence);
    }
    ++step_;
  }
  if (by != EndedBy::kNotYet || last_.sequence == 0) begin_step(sample);
  steer(sample);
  last_ = command(last_.sequence + 1);
  balance_next_ = false;
  return last_;
}

void ProgramRunner::stop() { end(EndedBy::kOperator, "stopped by the operator"); }

void ProgramRunner::balance() { balance_next_ = true; }

void ProgramRunner::fail(std::string why) {
  ended_by_ = EndedBy::kSolver;
  reason_ = std::move(why);
}

bool ProgramRunner::failed() const {
  return ended_by_ == EndedBy::kSolver || (ended_by_ == EndedBy::kUntangled && !only_ties()) ||
         (ended_by_ == EndedBy::kBreak && parts_too_early());
}

Phase ProgramRunner::phase() const { return ended() ? Phase::kDone : last_.phase; }

double ProgramRunner::period() const { return 1.0 / command_rate_; }

double ProgramRunner::progress() const {
  if (ended()) return 1.0;
  const double passed = last_.time;
  return passed / std::max(passed + time_left(), period());
}

double ProgramRunner::time_left() const {
  if (ended()) return 0.0;
  double left = std::max(0.0, estimated_duration(step()) - seconds(last_.sequence - step_begin_));
  for (std::size_t i = step_ + 1; i < program_.size(); ++i) left += estimated_duration(program_[i]);
  return left;
}

void ProgramRunner::state(Archive& archive) {
  archive.section("PRG6");  // "PRG5" remembered loads of the last moments, for sharp drops
  archive.same("steps of the program", static_cast<std::int64_t>(program_.size()));
  int step = static_cast<int>(step_);
  archive.number("step of the program", step, 0, static_cast<int>(program_.size()) - 1);
  archive.number("answers of an undone knot", undone_answers_, 0, kUndoneAnswers);
  step_ = static_cast<std::size_t>(step);
  archive(wanted_load_, balancing_, balance_offset_, gain_.extension, gain_.displacement, gain_.value);
  archive.require(gain_.value >= kLeastGain && gain_.value <= 1.0, "gain of the frame", std::to_string(gain_.value));
  archive(step_begin_, step_begin_load_, leg_.begin, leg_.displacement, leg_.velocity, outwards_, turns_, load_control_,
          break_detector_, last_, balance_next_, reason_);
  archive.choice("end of the test", ended_by_, EndedBy::kUntangled);
}

double ProgramRunner::seconds(std::uint64_t commands) const { return static_cast<double>(commands) / command_rate_; }

double ProgramRunner::estimated_duration(const ProgramStep& step) const {
  // Tie, mount and preload end when the specimen says so; their usual time stands for them.
  constexpr double kUsualTie = 10.0;
  constexpr double kUsualDistance = 0.01;
  switch (step.phase) {
    case Phase::kTie:
      return kUsualTie;
    case Phase::kMount:
    case Phase::kPreload:
      return kUsualDistance / step.speed;
    case Phase::kRelease:
    case Phase::kHold:
      return step.duration;
    case Phase::kPull: {
      const double by_speed = step.until.extension.value_or(limits_.travel) / step.speed;
      const double by_load = step.load_rate ? step.until.load.value_or(limits_.load) / *step.load_rate : by_speed;
      return std::min({by_speed, by_load, step.until.time.value_or(by_speed)});
    }
    case Phase::kCycle: {
      const double distance =
          step.extension_turns ? step.extension_turns->high - step.extension_turns->low : kUsualDistance;
      const double whole = 2.0 * distance * step.cycles / step.speed, time = step.until.time.value_or(whole);
      return step.cycles > 0 ? std::min(whole, time) : time;
    }
    case Phase::kReturn:
      return std::max(0.0, last_.displacement - step.return_extension) / step.speed;
    case Phase::kFollow:
      return step.recorded.empty() ? 0.0 : step.recorded.back().time;
    default:
      return period();
  }
}

void ProgramRunner::end(EndedBy by, std::string reason) {
  if (ended()) return;
  ended_by_ = by;
  reason_ = std::move(reason);
}

bool ProgramRunner::end_by_alarm(const Sample& sample) {
  const std::string phase = phase_name(last_.phase);
  if (sample.status == BenchStatus::kFailed) {
    end(EndedBy::kSolver, sample.message.empty() ? phase + ": the physics gave up" : sample.message);
  } else if (sample.status == BenchStatus::kBroken) {
    end(EndedBy::kBreak, parts_too_early() ? phase + ": " + sample.message + kTooEarly : sample.message);
  } else if (undone_answers_ == kUndoneAnswers && !only_ties()) {
    end(EndedBy::kUntangled, phase + ": the knot came undone");
  } else if (std::abs(sample.load) > limits_.load || std::abs(sample.force_upper) > limits_.load) {
    end(EndedBy::kLoad, phase + ": the load is beyond its limit, the load cell's capacity or ends.load");
  } else if (std::abs(last_.displacement) >= limits_.travel) {
    end(EndedBy::kTravel, phase + ": the crosshead is at the end of its travel");
  } else if (sample.end_to_end < limits_.least_distance) {
    end(EndedBy::kTravel, phase + ": the grips meet");
  } else if (const std::string seen = break_seen(sample); !seen.empty()) {
    end(EndedBy::kBreak, phase + ": " + seen);
  } else if (last_.time >= limits_.time) {
    end(EndedBy::kTime, phase + ": the test's time is over");
  }
  return ended();
}

bool ProgramRunner::only_ties() const {
  return std::all_of(program_.begin(), program_.end(), [](const ProgramStep& step) { return !moves(step.phase); });
}

bool ProgramRunner::was_pulled() const {
  const auto next = program_.begin() + static_cast<std::ptrdiff_t>(step_) + 1;
  return std::any_of(program_.begin(), next, [](const ProgramStep& step) { return pulls(step.phase); });
}

/// Whether a rod that parts now does so before the program has loaded it, in a step that prepares it or in one that a
/// load would follow. A rod that is held to the end may part under its own weight: such a test waits for that.
bool ProgramRunner::parts_too_early() const {
  const auto next = program_.begin() + static_cast<std::ptrdiff_t>(step_) + 1;
  const bool loaded = std::any_of(program_.begin(), next, loads);
  return !loaded && (traits_of(last_.phase).prepares || std::any_of(next, program_.end(), loads));
}

/// Whether the knot is gone before a step has pulled it.
bool ProgramRunner::is_undone(const Sample& sample) const {
  return sample.knot_type == KnotType::kChanged && !was_pulled();
}

std::string ProgramRunner::break_seen(const Sample& sample) {
  if (!traits_of(last_.phase).can_break) return {};
  // While the crosshead returns, loads fall as they should.
  if (leg_.velocity < 0.0) {
    break_detector_.begin();
    return {};
  }
  return break_detector_.judge(sample);
}

/// What is remembered of loads is told from the new zero.
void ProgramRunner::take_balance(const Sample& sample) {
  const double shift = sample.balance_offset - balance_offset_;
  balance_offset_ = sample.balance_offset;
  if (shift == 0.0) return;
  wanted_load_ -= shift;
  step_begin_load_ -= shift;
  load_control_.shift(shift);
  break_detector_.begin();
}

void ProgramRunner::learn_gain(const Sample& sample) {
  const double moved = sample.displacement - gain_.displacement;
  if (std::abs(moved) > kMetExtension && !last_.balance)
    gain_.value = std::clamp((sample.extension - gain_.extension) / moved, kLeastGain, 1.0);
  gain_.extension = sample.extension;
  gain_.displacement = sample.displacement;
}

/// Whether a load rose (sense 1) or fell (-1) to its target.
bool ProgramRunner::reached(double load, double target, double sense, double tolerance) const {
  return sense * (load - target) >= -tolerance;
}

EndedBy ProgramRunner::step_end(const Sample& sample) {
  const std::uint64_t commands = last_.sequence - step_begin_;
  // A time is over after as many whole periods as cover it; the slack is for times that are a multiple of the period.
  const auto over = [&](double time) { return static_cast<double>(commands) >= time * command_rate_ - 1e-6; };
  const ProgramStep& s = step();
  const double load = balanced_load(sample);
  switch (s.phase) {
    case Phase::kTie:
    case Phase::kRelease:
    case Phase::kMount:
      return sample.status == BenchStatus::kPhaseDone || sample.status == BenchStatus::kNotEquilibrated
                 ? EndedBy::kProgram
                 : EndedBy::kNotYet;
    case Phase::kPreload:
      if (!balancing_ && !reached(load, s.load, 1.0, kMetLoad * s.load)) return EndedBy::kNotYet;
      if (balancing_ || !s.balance) return EndedBy::kLoad;
      balancing_ = balance_next_ = true;
      return EndedBy::kNotYet;
    case Phase::kPull:
      if (s.until.extension && sample.extension >= *s.until.extension) return EndedBy::kExtension;
      if (s.until.load && reached(load, *s.until.load, 1.0, kMetLoad * *s.until.load)) return EndedBy::kLoad;
      return s.until.time && over(*s.until.time) ? EndedBy::kProgram : EndedBy::kNotYet;
    case Phase::kHold:
      return over(s.duration) ? EndedBy::kProgram : EndedBy::kNotYet;
    case Phase::kCycle:
      return cycles_over(sample) || (s.until.time && over(*s.until.time)) ? EndedBy::kProgram : EndedBy::kNotYet;
    case Phase::kReturn:
      if (sample.extension <= s.return_extension + met_extension()) return EndedBy::kExtension;
      return s.until.load && reached(load, *s.until.load, -1.0, kMetLoad * std::abs(step_begin_load_))
                 ? EndedBy::kLoad
                 : EndedBy::kNotYet;
    case Phase::kFollow:
      return over(s.recorded.back().time) ? EndedBy::kProgram : EndedBy::kNotYet;
    case Phase::kIdle:
    case Phase::kBalance:
    case Phase::kDone:
      break;
  }
  return EndedBy::kProgram;
}

/// Turns round where a turning point is reached.
bool ProgramRunner::cycles_over(const Sample& sample) {
  const ProgramStep& s = step();
  const double sense = outwards_ ? 1.0 : -1.0;
  const TurningPoints& turns = s.extension_turns ? *s.extension_turns : *s.load_turns;
  const double target = outwards_ ? turns.high : turns.low;
  const bool turned = s.extension_turns
                          ? reached(sample.extension, target, sense, met_extension())
                          : reached(balanced_load(sample), target, sense, kMetLoad * (turns.high - turns.low));
  if (!turned) return false;
  outwards_ = !outwards_;
  load_control_.begin();
  if (outwards_) break_detector_.begin();
  ++turns_;
  return s.cycles > 0 && turns_ >= 2 * s.cycles;
}

double ProgramRunner::met_extension() const {
  return gain_.value > kRigid ? kMetExtension : kMetByAFrame * step().speed * period();
}

void ProgramRunner::begin_step(const Sample& sample) {
  step_begin_ = last_.sequence;
  step_begin_load_ = wanted_load_ = balanced_load(sample);
  if (step().hold_load) wanted_load_ = step().held_load.value_or(step_begin_load_);
  balancing_ = false;
  outwards_ = true;
  turns_ = 0;
  load_control_.begin();
  break_detector_.begin();
  begin_leg(sample, first_velocity(step()));
}

/// Mounting, the crosshead takes up the slack by itself, and says where it is.
void ProgramRunner::begin_leg(const Sample& sample, double velocity) {
  leg_.begin = last_.sequence;
  leg_.displacement = last_.phase == Phase::kMount ? sample.displacement : last_.displacement;
  leg_.velocity = velocity;
}

/// Where the crosshead's speed follows from the last sample, the next command is a leg of its own.
void ProgramRunner::steer(const Sample& sample) {
  const ProgramStep& s = step();
  const double next_time = seconds(last_.sequence + 1 - step_begin_);
  const auto meet = [&](double load, bool creeps) {
    return load_control_.meeting(sample, load, period(), s.speed, creeps);
  };
  switch (s.phase) {
    case Phase::kMount:
      begin_leg(sample, s.speed);
      break;
    case Phase::kPreload:
      begin_leg(sample, balancing_ ? 0.0 : s.load_rate ? velocity_at_load_rate(sample) : meet(s.load, true));
      break;
    case Phase::kPull:
      if (s.load_rate) {
        begin_leg(sample, velocity_at_load_rate(sample));
      } else if (s.until.load) {
        const double speed = meet(*s.until.load, false);
        if (speed != leg_.velocity) begin_leg(sample, speed);
      }
      break;
    case Phase::kHold:
      if (s.hold_load) begin_leg(sample, load_control_.following(sample, wanted_load_, period(), s.speed));
      break;
    case Phase::kCycle:
      begin_leg(sample, velocity_of_cycle(sample));
      break;
    case Phase::kReturn: {
      const double to_extension = std::min(0.0, velocity_to_extension(s.return_extension - sample.extension));
      begin_leg(sample, s.until.load ? std::max(to_extension, -meet(*s.until.load, true)) : to_extension);
      break;
    }
    case Phase::kFollow:
      begin_leg(sample, (recorded_way(next_time) - recorded_way(seconds(last_.sequence - step_begin_))) / period());
      break;
    default:
      break;
  }
}

/// Towards an extension that is `left` [m] away, and no further.
double ProgramRunner::velocity_to_extension(double left) const {
  const double most = step().speed * period();
  return std::clamp(left / gain_.value, -most, most) / period();
}

double ProgramRunner::velocity_of_cycle(const Sample& sample) {
  const ProgramStep& s = step();
  if (s.extension_turns)
    return velocity_to_extension((outwards_ ? s.extension_turns->high : s.extension_turns->low) - sample.extension);
  const double target = outwards_ ? s.load_turns->high : s.load_turns->low;
  const double speed = load_control_.meeting(sample, target, period(), s.speed, true);
  return outwards_ ? speed : -speed;
}

/// Where the crosshead could go no faster the course begins anew from the present load: it is a rate, not a time table.
double ProgramRunner::velocity_at_load_rate(const Sample& sample) {
  const ProgramStep& s = step();
  if (leg_.velocity >= s.speed) wanted_load_ = balanced_load(sample);
  wanted_load_ += *s.load_rate * period();
  const double end = s.phase == Phase::kPreload ? s.load : s.until.load.value_or(wanted_load_);
  return load_control_.following(sample, std::min(wanted_load_, end), period(), s.speed);
}

/// The crosshead's way in the record at a time; it is linear between two rows [m].
double ProgramRunner::recorded_way(double time) const {
  const std::vector<RecordedPlace>& recorded = step().recorded;
  const auto after = std::lower_bound(recorded.begin(), recorded.end(), time,
                                      [](const RecordedPlace& row, double at) { return row.time < at; });
  if (after == recorded.begin()) return 0.0;
  if (after == recorded.end()) return recorded.back().displacement - recorded.front().displacement;
  const RecordedPlace &from = *(after - 1), &to = *after;
  const double fraction = (time - from.time) / (to.time - from.time);
  return from.displacement + fraction * (to.displacement - from.displacement) - recorded.front().displacement;
}

Command ProgramRunner::command(std::uint64_t sequence) const {
  Command c = last_;
  if (ended()) {
    c.phase = Phase::kDone;
    c.velocity = 0.0;
    c.balance = false;
    return c;
  }
  c = Command();
  c.sequence = sequence;
  c.time = seconds(sequence);
  c.read_cell = sequence % commands_per_reading_ == 0;
  c.step = -1;
  if (sequence == 0) return c;
  const ProgramStep& s = step();
  c.step = static_cast<int>(step_);
  c.phase = s.phase;
  c.speed = s.speed;
  c.duration = s.duration;
  c.velocity = leg_.velocity;
  // From the leg's beginning each time, so that rounding does not add up.
  c.displacement = leg_.displacement + c.velocity * seconds(sequence - leg_.begin);
  c.balance = s.phase == Phase::kBalance || balance_next_;
  return c;
}

}  // namespace knot_utm
