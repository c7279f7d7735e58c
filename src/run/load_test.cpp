#include "knot_utm/run/load_test.hpp"

#include <cmath>
#include <filesystem>
#include <system_error>

#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/run/csv.hpp"
#include "knot_utm/verdict/result_keys.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

/// From which load on a fall may be a break: testing machines have such a fraction.
constexpr double kArmingFraction = 0.02;  // of the cell's capacity

/// Reads the motion of the crosshead that a step follows, from the record of another test. One that is faster than any
/// testing machine is in other units than it says, or is none. `follow`: the key of the step.
void read_record(const std::string& follow, FollowStep& step, const Tell& tell) {
  const std::string key = follow + ".record";
  step.record = curve_file_of(step.record);
  std::error_code error;
  if (!std::filesystem::is_regular_file(step.record, error)) throw InvalidInput::cannot_read(step.record, key);
  const std::vector<CurveRow> course = read_course(step.record, tell);
  for (const CurveRow& row : course) {
    const RecordedPlace to{row.time - course.front().time, travel_of(row) - travel_of(course.front())};
    if (!step.recorded.empty()) {
      const RecordedPlace& from = step.recorded.back();
      if (!(to.time > from.time)) continue;
      const double speed = std::abs(to.displacement - from.displacement) / (to.time - from.time);
      if (speed > kFastestCrosshead)
        throw InvalidInput::sentence(key, key + ": the crosshead of " + shown(step.record) + " moves at " +
                                              format_number(speed) + " m/s at " + format_number(from.time) +
                                              " s, but must be no faster than " + format_number(kFastestCrosshead) +
                                              " m/s");
    }
    step.recorded.push_back(to);
  }
  if (step.recorded.size() < 2)
    throw InvalidInput::sentence(
        key, key + ": " + shown(step.record) + " has fewer than 2 readings of the pull at different times");
}

/// Reads the records that have not been read yet.
void read_records(Program& program, const Tell& tell) {
  for (std::size_t i = 0; i < program.size(); ++i)
    if (FollowStep* follow = program[i].as<FollowStep>(); follow && follow->recorded.empty())
      read_record("program." + std::to_string(i) + ".follow", *follow, tell);
}

}  // namespace

Method load_test(const std::string& file, const std::vector<std::string>& overrides, const Tell& tell,
                 const std::string& option) {
  Method method = load_method(file, overrides, option);
  try {
    check_specification(method.specification);
    read_records(method.program, tell);
  } catch (const InvalidInput& invalid) {
    throw invalid.in_file(file);
  }
  return method;
}

ProgramRunner make_program(const Method& method, double longest_step) {
  Program program = method.program;
  read_records(program, nullptr);
  ProgramRunner::Limits limits;
  const MachineOptions& machine = method.machine;
  const double capacity = machine.load_cell.capacity;
  limits.load = method.ends.load.value_or(capacity);
  limits.least_distance =
      (machine.grips == GripKind::kRollers ? machine.roller_diameter : 0.0) + 2.0 * method.material.radius;
  limits.travel = machine.travel;
  limits.time = method.ends.time.value_or(limits.time);
  limits.breaks = {method.ends.break_at_fraction_of_peak, kArmingFraction * capacity};
  return ProgramRunner(program, machine.load_cell.sampling_rate, longest_step, limits);
}

}  // namespace knot_utm
