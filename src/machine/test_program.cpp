#include "knot_utm/machine/test_program.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace knot_utm {
namespace {

bool moves(Phase phase) { return phase == Phase::kMount || phase == Phase::kPreload || phase == Phase::kPull; }

}  // namespace

const char* ended_by_name(EndedBy end) {
  switch (end) {
    case EndedBy::kNotYet:
      return "not yet";
    case EndedBy::kBreak:
      return "break";
    case EndedBy::kExtension:
      return "extension";
    case EndedBy::kLoad:
      return "load";
    case EndedBy::kTravel:
      return "travel";
    case EndedBy::kOperator:
      return "operator";
    case EndedBy::kSolver:
      return "solver";
    case EndedBy::kProgram:
      return "program";
  }
  return "not yet";
}

TestProgram::TestProgram(Program program, double sampling_rate, double longest_period, Limits limits)
    : program_(std::move(program)), limits_(limits) {
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

Command TestProgram::next(const Sample& sample) {
  if (ended()) return command(last_.sequence);
  if (sample.sequence != last_.sequence) {
    throw std::invalid_argument("the sample answers command " + std::to_string(sample.sequence) + ", not command " +
                                std::to_string(last_.sequence));
  }
  if (end_by_alarm(sample)) return command(last_.sequence);

  const EndedBy by = last_.sequence == 0 ? EndedBy::kNotYet : step_end(sample);
  if (by != EndedBy::kNotYet) {
    step_begin_ = last_.sequence;
    step_begin_displacement_ = last_.displacement;
    if (step_ + 1 == program_.size()) {
      end(by, "");
      return command(last_.sequence);
    }
    ++step_;
  }
  last_ = command(last_.sequence + 1);
  balance_next_ = false;
  return last_;
}

void TestProgram::stop() { end(EndedBy::kOperator, "stopped by the operator"); }

void TestProgram::balance() { balance_next_ = true; }

Phase TestProgram::phase() const { return ended() ? Phase::kDone : last_.phase; }

double TestProgram::period() const { return 1.0 / command_rate_; }

double TestProgram::progress() const {
  if (ended()) return 1.0;
  const double passed = last_.time;
  return passed / std::max(passed + time_left(), period());
}

double TestProgram::time_left() const {
  if (ended()) return 0.0;
  double left = std::max(0.0, estimated_duration(step()) - seconds(last_.sequence - step_begin_));
  for (std::size_t i = step_ + 1; i < program_.size(); ++i) left += estimated_duration(program_[i]);
  return left;
}

void TestProgram::state(Archive& archive) {
  archive.section("PRGM");  // "PROG" had a command's fields in another order
  archive.same("steps of the program", static_cast<std::int64_t>(program_.size()));
  int step = static_cast<int>(step_);
  archive.number("step of the program", step, 0, static_cast<int>(program_.size()) - 1);
  step_ = static_cast<std::size_t>(step);
  archive(step_begin_, step_begin_displacement_, last_, balance_next_, reason_);
  archive.choice("end of the test", ended_by_, EndedBy::kProgram);
}

double TestProgram::seconds(std::uint64_t commands) const { return static_cast<double>(commands) / command_rate_; }

double TestProgram::estimated_duration(const ProgramStep& step) const {
  // Tie, mount and preload end when the specimen says so; their usual time stands for them.
  constexpr double kUsualTie = 10.0;
  constexpr double kUsualWay = 0.01;
  switch (step.phase) {
    case Phase::kTie:
      return kUsualTie;
    case Phase::kMount:
    case Phase::kPreload:
      return kUsualWay / step.speed;
    case Phase::kRelease:
    case Phase::kHold:
      return step.duration;
    case Phase::kPull:
      return std::min(step.until.extension.value_or(limits_.travel) / step.speed,
                      step.until.time.value_or(limits_.travel / step.speed));
    default:
      return period();
  }
}

void TestProgram::end(EndedBy by, std::string reason) {
  if (ended()) return;
  ended_by_ = by;
  reason_ = std::move(reason);
}

bool TestProgram::end_by_alarm(const Sample& sample) {
  const std::string phase = phase_name(last_.phase);
  if (sample.status == BenchStatus::kFailed) {
    end(EndedBy::kSolver, sample.message.empty() ? phase + ": the physics gave up" : sample.message);
  } else if (sample.status == BenchStatus::kBroken) {
    end(EndedBy::kBreak, sample.message);
  } else if (std::abs(sample.load) > limits_.load || std::abs(sample.force_upper) > limits_.load) {
    end(EndedBy::kLoad, phase + ": the load is beyond the load cell's capacity");
  } else if (std::abs(last_.displacement) >= limits_.travel) {
    end(EndedBy::kTravel, phase + ": the crosshead is at the end of its way");
  }
  return ended();
}

EndedBy TestProgram::step_end(const Sample& sample) const {
  const std::uint64_t commands = last_.sequence - step_begin_;
  // A time is over after as many whole periods as cover it; the slack is for times that are a multiple of the period.
  const auto over = [&](double time) { return static_cast<double>(commands) >= time * command_rate_ - 1e-6; };
  const ProgramStep& s = step();
  switch (s.phase) {
    case Phase::kTie:
    case Phase::kRelease:
    case Phase::kMount:
      return sample.status == BenchStatus::kPhaseDone || sample.status == BenchStatus::kNotEquilibrated
                 ? EndedBy::kProgram
                 : EndedBy::kNotYet;
    case Phase::kPreload:
      return sample.load >= s.load ? EndedBy::kLoad : EndedBy::kNotYet;
    case Phase::kPull:
      if (s.until.extension && sample.extension >= *s.until.extension) return EndedBy::kExtension;
      if (s.until.load && sample.load >= *s.until.load) return EndedBy::kLoad;
      return s.until.time && over(*s.until.time) ? EndedBy::kProgram : EndedBy::kNotYet;
    case Phase::kHold:
      return over(s.duration) ? EndedBy::kProgram : EndedBy::kNotYet;
    case Phase::kIdle:
    case Phase::kBalance:
    case Phase::kDone:
      break;
  }
  return EndedBy::kProgram;
}

Command TestProgram::command(std::uint64_t sequence) const {
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
  c.velocity = moves(s.phase) ? s.speed : 0.0;
  // From the step's beginning each time, so that rounding does not add up.
  c.displacement = step_begin_displacement_ + c.velocity * seconds(sequence - step_begin_);
  c.balance = s.phase == Phase::kBalance || balance_next_;
  return c;
}

}  // namespace knot_utm
