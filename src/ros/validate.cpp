#include "knot_utm/ros/validate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "knot_utm/numeric/number.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/program.hpp"
#include "knot_utm/record/sample_fields.hpp"

namespace knot_utm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLongestStep = 0.5;      // of any physics [s]
constexpr double kLongestDuration = 1e6;  // of any step of a program [s]
constexpr double kSlack = 1e-9;           // relative, for what was rounded
constexpr std::size_t kLongestText = 8192;
constexpr std::size_t kMostSteps = 1000000;  // of the physics in one command: the longest step over the shortest
constexpr std::size_t kMostNodes = 1000000;

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

/// Asks one thing after the other and keeps the first answer that is wrong.
class Check {
 public:
  explicit Check(std::string prefix = "") : prefix_(std::move(prefix)) {}

  Check& number(const char* field, double value, double low = -kInfinity, double high = kInfinity) {
    const bool right = std::isfinite(value) && value >= low && value <= high;
    return right ? *this : wrong(field, format_number(value), range(low, high));
  }
  /// As `number`, or not-a-number for what is not there.
  Check& number_or_none(const char* field, double value, double low = -kInfinity) {
    return std::isnan(value) ? *this : number(field, value, low);
  }
  Check& count(const char* field, std::uint64_t value, std::uint64_t low, std::uint64_t high) {
    const bool right = value >= low && value <= high;
    return right ? *this : wrong(field, std::to_string(value), std::to_string(low) + " to " + std::to_string(high));
  }
  Check& phase(const std::string& value) {
    return phase_named(value) ? *this : wrong("phase", "\"" + one_line(value) + "\"", "a phase of a test");
  }
  Check& text(const char* field, const std::string& value) {
    if (value.size() > kLongestText) {
      return wrong(field, std::to_string(value.size()) + " characters", "at most " + std::to_string(kLongestText));
    }
    const bool plain = std::none_of(value.begin(), value.end(), is_control);
    return plain ? *this : wrong(field, "\"" + one_line(value) + "\"", "one line of text");
  }
  /// `value` and `allowed` give texts, which cost something and are seldom wanted.
  template <class Value, class Allowed>
  Check& that(bool right, const char* field, Value value, Allowed allowed) {
    return right ? *this : wrong(field, value(), allowed());
  }
  /// Of a message inside this one.
  Check& part(const std::string& fault) {
    if (fault_.empty()) fault_ = fault;
    return *this;
  }
  const std::string& fault() const { return fault_; }

 private:
  static std::string range(double low, double high) {
    if (std::isfinite(low) && std::isfinite(high)) return format_number(low) + " to " + format_number(high);
    return std::isfinite(low) ? format_number(low) + " or more and finite" : "a finite number";
  }
  Check& wrong(const char* field, const std::string& value, const std::string& allowed) {
    if (fault_.empty()) fault_ = prefix_ + field + " is " + value + ", but must be " + allowed;
    return *this;
  }

  std::string prefix_;
  std::string fault_;
};

/// A number in a field of a sample, or in one of its places.
void check_number(Check& check, const char* name, Allowed allowed, double value) {
  const double low = may_be_negative(allowed) ? -kInfinity : 0.0;
  if (may_be_none(allowed)) {
    check.number_or_none(name, value, low);
  } else {
    check.number(name, value, low);
  }
}

/// What a message has in a field of its sample.
template <class Field, class Value>
void check_field(Check& check, const Field& field, const Value& value) {
  using InSample = ValueOf<Field>;
  if constexpr (std::is_same_v<InSample, Phase>) {
    check.phase(value);
  } else if constexpr (std::is_enum_v<InSample>) {
    check.count(field.name, value, 0, static_cast<std::uint64_t>(last_of(InSample())));
  } else if constexpr (std::is_same_v<InSample, std::string>) {
    check.text(field.name, value);
  } else if constexpr (std::is_same_v<InSample, PerKnot>) {
    check.that(
        value.size() <= PerKnot::kMost, field.name, [&] { return "of " + std::to_string(value.size()) + " knots"; },
        [] { return "of at most " + std::to_string(PerKnot::kMost); });
    for (std::size_t i = 0; i < value.size(); ++i)
      check_number(check, (field.name + ("[" + std::to_string(i) + "]")).c_str(), field.allowed, value[i]);
  } else if (field.allowed != Allowed::kAny) {
    check_number(check, field.name, field.allowed, static_cast<double>(value));
  }
}

std::string fault_of_state(const KnotState& m, const std::string& prefix) {
  Check check(prefix);
  check.text("header.frame_id", m.header.frame_id);
  visit_sample_fields([&](const auto& field) { check_field(check, field, field.of(m)); });
  return check.text("motion_pattern", m.motion_pattern).fault();
}

/// Of a rod that has parted no tension is known.
std::string fault_of_shape(const KnotShape& m, bool parted) {
  const auto finite = [](const geometry_msgs::Point& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  };
  const std::size_t edges = m.points.empty() ? 0 : m.points.size() - 1;
  const auto lost = std::find_if_not(m.points.begin(), m.points.end(), finite);
  const auto torn = std::find_if_not(m.tension.begin(), m.tension.end(),
                                     [parted](double t) { return std::isfinite(t) || (parted && std::isnan(t)); });
  const auto finite_numbers = [] { return "finite numbers"; };
  return Check("shape.")
      .text("header.frame_id", m.header.frame_id)
      .count("points", m.points.size(), 0, kMostNodes)
      .that(
          m.tension.size() == edges, "tension", [&] { return std::to_string(m.tension.size()) + " edges"; },
          [&] { return std::to_string(edges); })
      .that(
          lost == m.points.end(), "points",
          [&] { return "not finite at point " + std::to_string(lost - m.points.begin()); }, finite_numbers)
      .that(
          torn == m.tension.end(), "tension",
          [&] { return "not finite at edge " + std::to_string(torn - m.tension.begin()); }, finite_numbers)
      .fault();
}

std::string fault_of_command(const Crosshead& m, const CrossheadLimits& limits, const std::string& prefix) {
  const double reach = limits.travel + kFastestCrosshead * limits.longest_step;
  return Check(prefix)
      .text("header.frame_id", m.header.frame_id)
      .count("run", m.run, 1, std::numeric_limits<std::uint32_t>::max())
      .number("time", m.time, 0.0)
      .that(
          m.sequence > 0 || m.time == 0.0, "time", [&] { return format_number(m.time); },
          [] { return "0 where the sequence is 0"; })
      // No test begins before the clock does.
      .number("header.stamp", m.header.stamp.toSec(), m.time * (1.0 - kSlack) - 1e-6)
      .number("displacement", m.displacement, -reach, reach)
      .number("velocity", m.velocity, -kFastestCrosshead, kFastestCrosshead)
      .that(
          m.step >= -1, "step", [&] { return std::to_string(m.step); }, [] { return "-1 or more"; })
      .phase(m.phase)
      .number("speed", m.speed, 0.0, kFastestCrosshead)
      .number("duration", m.duration, 0.0, kLongestDuration)
      .fault();
}

}  // namespace

std::string fault_of(const Crosshead& message, const CrossheadLimits& limits) {
  return fault_of_command(message, limits, "");
}

std::string fault_after(const Crosshead& last, const Crosshead& message, const CrossheadLimits& limits) {
  const double passed = message.time - last.time;
  const double moved = message.displacement - last.displacement;
  const double farthest = kFastestCrosshead * passed + kSlack;
  return Check()
      .that(
          passed > 0.0 && passed <= limits.longest_step * (1.0 + kSlack) + kSlack, "time",
          [&] { return format_number(message.time); },
          [&] { return "after " + format_number(last.time) + " by at most " + format_number(limits.longest_step); })
      .that(
          std::abs(moved) <= farthest, "displacement", [&] { return format_number(message.displacement); },
          [&] { return "within " + format_number(farthest) + " of " + format_number(last.displacement); })
      .fault();
}

std::string fault_of(const KnotState& message) { return fault_of_state(message, ""); }

std::string fault_of(const KnotRecord& m) {
  // The machine's limits are between machine and physics; here only what no machine has.
  CrossheadLimits any;
  any.travel = kInfinity;
  Check check;
  check.part(fault_of_command(m.command, any, "command."))
      .part(fault_of_state(m.answer, "answer."))
      .that(
          m.answer.run == m.command.run && m.answer.sequence == m.command.sequence, "answer.sequence",
          [&] { return std::to_string(m.answer.sequence); },
          [&] { return "that of the command, " + std::to_string(m.command.sequence); })
      .count("steps", m.steps.size(), 0, kMostSteps)
      .part(fault_of_shape(m.shape, m.answer.status == KnotState::BROKEN))
      .that(
          m.failed_step.empty() || m.answer.status == KnotState::FAILED, "failed_step",
          [&] { return std::to_string(m.failed_step.size()) + " bytes"; },
          [] { return "empty where the physics did not give up"; });
  for (std::size_t i = 0; i < m.steps.size() && check.fault().empty(); ++i) {
    check.part(fault_of_state(m.steps[i], "steps[" + std::to_string(i) + "]."));
  }
  return check.fault();
}

std::string fault_of(const SpecimenInfo& m) {
  return Check()
      .text("header.frame_id", m.header.frame_id)
      .number("longest_step", m.longest_step, 1e-6, kLongestStep)
      .number("radius", m.radius, 0.0)
      .number("length", m.length, 0.0)
      .fault();
}

std::string fault_of(const TestStatus& m) {
  return Check()
      .text("header.frame_id", m.header.frame_id)
      .count("state", m.state, TestStatus::IDLE, TestStatus::ENDED)
      .phase(m.phase)
      .text("ended_by", m.ended_by)
      .text("reason", m.reason)
      .number("progress", m.progress, 0.0, 1.0)
      .number("time", m.time, 0.0)
      .fault();
}

std::string one_line(const std::string& text) {
  constexpr std::size_t kLine = 200;
  std::string line = text.substr(0, kLine);
  std::replace_if(line.begin(), line.end(), is_control, ' ');
  return text.size() > kLine ? line + "..." : line;
}

}  // namespace knot_utm
