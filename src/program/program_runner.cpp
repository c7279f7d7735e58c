#include "knot_utm/program/program_runner.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {

std::string BreakDetector::judge(const Sample& sample) {
  if (!detection_.fraction_of_peak) return {};
  // It is not known whether the largest or the least load of a command came first. The larger of two falls counts: from
  // the peak before to the least load, and from the peak so far to the load at the end.
  double from = peak_, to = sample.lowest_load;
  peak_ = std::max(peak_, sample.highest_load);
  if (peak_ - balanced_load(sample) > from - to) {
    from = peak_;
    to = balanced_load(sample);
  }
  if (peak_ <= 0.0 || peak_ < detection_.arming_load) return {};
  if (!(from > to) || to > *detection_.fraction_of_peak * from) return {};
  std::ostringstream out;
  out << "the load fell from " << from << " to " << to << " N";
  return out.str();
}

namespace {

constexpr int kUndoneAnswers = 3;  // in a row: one answer may mistake a strand that is thrown about for another knot

ProgramStep step_of(const CrossheadMove& move, const Sample& now, double pull_speed) {
  const std::optional<double> extension = move.extension != 0.0 ? std::optional(move.extension) : std::nullopt;
  const std::optional<double> load = move.load != 0.0 ? std::optional(move.load) : std::nullopt;
  const double speed = move.speed > 0.0 ? move.speed : pull_speed;
  if (load ? *load > balanced_load(now) : extension && *extension > now.extension) {
    PullStep out;
    out.speed = speed;
    out.until.extension = extension;
    out.until.load = load;
    return out;
  }
  ReturnStep in;
  in.speed = speed;
  in.extension = extension.value_or(std::min(0.0, now.extension));
  in.load = extension || load ? load : 0.0;
  return in;
}

/// The slack keeps a period that is meant to be equal from being halved by rounding.
std::uint64_t commands_per_reading(double sampling_rate, double longest_period) {
  if (!(sampling_rate > 0.0) || !(longest_period > 0.0))
    throw std::invalid_argument("a test program needs a positive sampling rate and period");
  return static_cast<std::uint64_t>(std::max(1.0, std::ceil(1.0 / (sampling_rate * longest_period) - 1e-9)));
}

}  // namespace

ProgramRunner::ProgramRunner(Program program, double sampling_rate, double longest_period, Limits limits)
    : program_(std::move(program)),
      limits_(limits),
      commands_per_reading_(commands_per_reading(sampling_rate, longest_period)),
      course_(static_cast<double>(commands_per_reading_) * sampling_rate, limits.load, limits.travel),
      break_detector_(limits.breaks) {
  if (program_.empty()) throw std::invalid_argument("a test program needs a step");
  const auto pull = std::find_if(program_.begin(), program_.end(), [](auto& step) { return pulls(step->phase()); });
  pull_speed_ = pull == program_.end() ? PullStep().speed : (*pull)->speed;
  course_.accept(command(0));
}

Command ProgramRunner::next(const Sample& sample) {
  if (ended()) return command(last().sequence);
  if (waits()) return last();
  if (sample.sequence != last().sequence)
    throw std::invalid_argument("the sample answers command " + std::to_string(sample.sequence) + ", not command " +
                                std::to_string(last().sequence));
  if (course_.take(sample)) break_detector_.begin();
  undone_answers_ = is_undone(sample) ? std::min(undone_answers_ + 1, kUndoneAnswers) : 0;
  if (end_by_alarm(sample)) return command(last().sequence);

  const bool first = last().sequence == 0;
  const bool gives_way = stands_ || (move_ && !prepares(last().phase));
  const EndedBy by = first       ? EndedBy::kNotYet
                     : gives_way ? EndedBy::kOperator
                                 : program_[step_]->ended(sample, course_);
  if (by != EndedBy::kNotYet && !begin_next_step(by, sample)) return command(last().sequence);
  if (first && may_lead_from(0)) lead_from(0, sample);
  if (by != EndedBy::kNotYet || first) {
    course_.begin_step(sample);
    break_detector_.begin();
    program_[step_]->begin(sample, course_);
  }
  program_[step_]->steer(sample, course_);
  course_.accept(command(last().sequence + 1));
  return last();
}

/// The next step, which may be a move of the operator; false: there is none.
bool ProgramRunner::begin_next_step(EndedBy by, const Sample& sample) {
  stands_ = waits_ = false;
  if (may_lead_from(step_ + 1)) {
    lead_from(step_ + 1, sample);
  } else if (led_) {
    waits_ = true;
    led_by_ = by;
    return false;
  } else if (step_ + 1 == program_.size()) {
    // A program that only ties ends as programmed even if its knot is gone, but that is how the test ended.
    end(is_undone(sample) ? EndedBy::kUntangled : by, "");
    return false;
  }
  ++step_;
  return true;
}

/// Whether the operator's move replaces the steps from this one on, before which the specimen is prepared.
bool ProgramRunner::may_lead_from(std::size_t step) const {
  return move_ && (step == program_.size() || !prepares(program_[step]->phase()));
}

void ProgramRunner::lead_from(std::size_t step, const Sample& sample) {
  program_.erase(program_.begin() + static_cast<std::ptrdiff_t>(step), program_.end());
  program_.push_back(step_of(*move_, sample, pull_speed_));
  move_.reset();
  led_ = true;
}

bool ProgramRunner::stand() {
  move_.reset();
  stands_ = led_ && !waits_;
  return stands_;
}

void ProgramRunner::fail(std::string why) {
  ended_by_ = EndedBy::kSolver;
  reason_ = std::move(why);
}

bool ProgramRunner::failed() const {
  return ended_by_ == EndedBy::kSolver || (ended_by_ == EndedBy::kUntangled && !only_ties()) ||
         (ended_by_ == EndedBy::kBreak && parts_too_early());
}

double ProgramRunner::progress() const {
  if (ended()) return 1.0;
  const double passed = last().time;
  return passed / std::max(passed + time_left(), period());
}

double ProgramRunner::time_left() const {
  if (ended()) return 0.0;
  double left = std::max(0.0, program_[step_]->usual_duration(course_) - course_.time());
  for (std::size_t i = step_ + 1; i < program_.size(); ++i) left += program_[i]->usual_duration(course_);
  return left;
}

void ProgramRunner::end(EndedBy by, std::string reason) {
  if (ended()) return;
  ended_by_ = by;
  reason_ = std::move(reason);
}

bool ProgramRunner::end_by_alarm(const Sample& sample) {
  const std::string phase = phase_name(last().phase);
  if (sample.status == BenchStatus::kFailed) {
    end(EndedBy::kSolver, sample.message.empty() ? phase + ": the physics gave up" : sample.message);
  } else if (sample.status == BenchStatus::kBroken) {
    end(EndedBy::kBreak, parts_too_early() ? phase + ": " + sample.message + kTooEarly : sample.message);
  } else if (undone_answers_ == kUndoneAnswers && !only_ties()) {
    end(EndedBy::kUntangled, phase + ": the knot came undone");
  } else if (const double force = std::max(std::abs(sample.load), std::abs(sample.force_upper));
             reached(force, limits_.load, 1.0, kLoadTolerance * limits_.load)) {
    end(EndedBy::kLoad, phase + ": the load is beyond its limit, the load cell's capacity or ends.load");
  } else if (std::abs(last().displacement) >= limits_.travel) {
    end(EndedBy::kTravel, phase + ": the crosshead is at the end of its travel");
  } else if (sample.end_to_end < limits_.least_distance) {
    end(EndedBy::kTravel, phase + ": the grips meet");
  } else if (const std::string seen = break_seen(sample); !seen.empty()) {
    end(EndedBy::kBreak, phase + ": " + seen);
  } else if (last().time >= limits_.time) {
    end(EndedBy::kTime, phase + ": the test's time is over");
  }
  return ended();
}

bool ProgramRunner::only_ties() const {
  return std::all_of(program_.begin(), program_.end(), [](const ProgramStep& step) { return !moves(step->phase()); });
}

/// Whether a rod that parts now has not been loaded yet: no step so far loads it, and this one prepares it or a later
/// one would load it. A rod that is only held to the end of the test may part under its own weight.
bool ProgramRunner::parts_too_early() const {
  const auto next = program_.begin() + static_cast<std::ptrdiff_t>(step_) + 1;
  const auto loads = [](const ProgramStep& step) { return step->loads(); };
  const bool loaded = std::any_of(program_.begin(), next, loads);
  return !loaded && (prepares(last().phase) || std::any_of(next, program_.end(), loads));
}

/// Whether the knot is gone before a step has pulled it.
bool ProgramRunner::is_undone(const Sample& sample) const {
  const auto next = program_.begin() + static_cast<std::ptrdiff_t>(step_) + 1;
  return sample.knot_type == KnotType::kChanged &&
         std::none_of(program_.begin(), next, [](const ProgramStep& step) { return pulls(step->phase()); });
}

std::string ProgramRunner::break_seen(const Sample& sample) {
  if (!can_break(last().phase)) return {};
  // While the crosshead returns, loads fall as they should.
  if (course_.velocity() < 0.0) {
    break_detector_.begin();
    return {};
  }
  return break_detector_.judge(sample);
}

Command ProgramRunner::command(std::uint64_t sequence) const {
  Command c;
  if (ended()) {
    c = last();
    c.phase = Phase::kDone;
    c.velocity = 0.0;
    c.balance = false;
    return c;
  }
  c.sequence = sequence;
  c.time = course_.seconds(sequence);
  c.read_cell = sequence % commands_per_reading_ == 0;
  c.step = -1;
  if (sequence == 0) return c;
  const ProgramStep& step = program_[step_];
  c.step = static_cast<int>(step_);
  c.phase = step->phase();
  c.speed = step->speed;
  c.duration = step->duration;
  course_.write_motion(c);
  return c;
}

}  // namespace knot_utm
