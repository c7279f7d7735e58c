#include "knot_utm/ros/run_bag.hpp"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <knot_utm/TestStatus.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/ros/conversions.hpp"
#include "knot_utm/ros/curve_bag.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/tying/tied_loop.hpp"

namespace knot_utm {

void write_readings(BagWriter& bag, const std::vector<CurveRow>& rows, double begin, const char* crosshead,
                    const char* load_cell) {
  Command command;
  Sample sample;
  ros::Time stamp;
  const bool has_crosshead = has_travel(rows);
  for (const CurveRow& row : rows) {
    stamp = std::max(test_stamp(begin - rows.front().time, row.time), stamp + ros::Duration(0, 1));
    const double passed = row.time - command.time;
    command.velocity = passed > 0.0 ? (travel_of(row) - command.displacement) / passed : 0.0;
    command.time = row.time;
    command.displacement = travel_of(row);
    command.phase = row.phase;
    command.read_cell = true;
    sample.load = row.load;
    if (has_crosshead) bag.write(crosshead, stamp, to_message(command, 1, stamp));
    bag.write(load_cell, stamp, to_wrench(sample, stamp));
    ++command.sequence;
  }
}

RunBag::RunBag(const std::string& file, const Method& method, std::string beside)
    : bag_(file),
      method_(method),
      beside_(std::move(beside)),
      centreline_(specimen_centreline(method.specimen, method.material, method.machine, method.physics)),
      grips_(method.specimen, method.machine, centreline_, method.material),
      crosshead_(grips_.lower() + Vec3(0.0, 0.0, method.specimen.end_to_end)),
      picture_(method.specimen, method.machine, method.material),
      motion_(rollers_hold(method.specimen, method.machine), 0.0, marks_of(method.specimen, method.program)) {}

void RunBag::add(const Record& record) {
  const Command& command = record.command;
  const Sample& sample = record.answer;
  const ros::Time stamp = test_stamp(0.0, command.time);
  const auto left = static_cast<std::ptrdiff_t>(method_.program.size()) - command.step;
  if (command.step > command_.step && left > 0) {  // a move is in no program
    const auto step = method_.program.end() - left;
    const auto pulling = [](const ProgramStep& other) { return pulls(other->phase()); };
    const auto* follow = step->as<FollowStep>();
    const bool is_last = pulling(*step) && std::none_of(step + 1, method_.program.end(), pulling);
    const std::string file = follow ? follow->record : is_last ? beside_ : "";
    if (std::filesystem::exists(file))  // it may have been removed since the test
      write_readings(bag_, follow ? read_course(file) : read_record(file), command_.time, "experiment/crosshead",
                     "experiment/load_cell");
  }
  cell_readings_.add(record, [this](const Sample& reading) { add_reading(reading); });
  command_ = command;
  answer_ = sample;
  const Crosshead crosshead = to_message(command, kRun, stamp);
  bag_.write(names::kCrosshead, stamp, crosshead);
  bag_.write(names::kJointStates, stamp, to_joint_state(command, sample, stamp));
  motion_.add(sample);
  KnotState state = to_message(sample, kRun, stamp);
  put_motion(motion_, state);
  bag_.write(names::kKnotState, stamp, state);
  if (shape_is_due(command, sample) && record.shape.cols() > 0) {
    bag_.write(names::kKnotShape, stamp, to_message(record.shape, record.tension, method_.material.radius, crosshead));
    if (!begun_) {
      picture_.begin(record.shape, centreline_.cuts);
      std_msgs::String text;
      text.data = method_yaml(method_);
      bag_.write_latched(names::kMethod, stamp, text);
      text.data = machine_urdf(method_, grips_.lower(), grips_.upper(0.0));
      bag_.write_latched(names::kRobotDescription, stamp, text);
      SpecimenInfo specimen;
      specimen.header.stamp = stamp;
      put_specimen(method_, record.shape, centreline_.cuts, specimen);
      bag_.write_latched(names::kSpecimen, stamp, specimen);
      bag_.write_latched(names::kColors, stamp, picture_.scale().bar());
      bag_.write_latched(names::kBodies, stamp, picture_.bodies());
      bag_.write_latched("tf_static", stamp, fixed_frames(grips_.lower(), stamp));
    }
    begun_ = true;
    add_status({});
    add_picture(record, stamp);
  }
}

void RunBag::close(const TestEnd& end) {
  cell_readings_.end([this](const Sample& reading) { add_reading(reading); });
  if (begun_ && end.ended_by != EndedBy::kNotYet) add_status(end);
  bag_.close();
}

void RunBag::add_reading(const Sample& reading) {
  const bool parted = reading.status == BenchStatus::kBroken;
  if (parted && answer_.status == BenchStatus::kBroken) return;  // it answers every command with the same
  const ros::Time stamp = test_stamp(0.0, reading.time);
  if (parted) bag_.write(names::kKnotState, stamp, to_message(reading, kRun, stamp));
  bag_.write(names::kLoadCell, stamp, to_wrench(reading, stamp));
}

/// How the test stands after the last command.
void RunBag::add_status(const TestEnd& end) {
  const bool ended = end.ended_by != EndedBy::kNotYet;
  const ros::Time stamp = test_stamp(0.0, command_.time);
  TestStatus status;
  status.header.stamp = stamp;
  status.state = ended ? TestStatus::ENDED : TestStatus::RUNNING;
  status.run = kRun;
  status.sequence = command_.sequence;
  status.phase = phase_name(ended ? Phase::kDone : command_.phase);
  if (ended) status.ended_by = ended_by_name(end.ended_by);
  status.reason = end.reason;
  status.time = command_.time;
  status.progress = status.time_left = status.real_time_factor = std::nan("");
  bag_.write_latched(names::kTestStatus, stamp, status);

  diagnostic_msgs::DiagnosticArray health;
  health.header.stamp = stamp;
  health.status.resize(2);
  auto &machine = health.status[0], &physics = health.status[1];
  machine.name = "utm_node: machine";
  machine.message = ended ? in_words(end) : "running";
  if (end.ended_by == EndedBy::kSolver || end.ended_by == EndedBy::kUntangled || end.ended_by == EndedBy::kInterrupted)
    machine.level = machine.ERROR;
  physics.name = "knot_node: physics";
  physics.message = answer_.message.empty() ? phase_name(answer_.phase) : answer_.message;
  if (answer_.status == BenchStatus::kFailed) physics.level = physics.ERROR;
  bag_.write("diagnostics", stamp, health);
}

void RunBag::add_picture(const Record& record, const ros::Time& stamp) {
  const Sample& sample = record.answer;
  // On a compliant frame the grip goes less far than the crosshead.
  const Vec3 upper_grip = grips_.upper(sample.end_to_end - grips_.end_to_end(0.0));
  bag_.write("tf", stamp,
             moving_frames(crosshead_, sample.displacement, upper_grip, picture_.knot(record.shape), stamp));
  bag_.write(names::kMarkers, stamp, picture_.draw({record.shape, record.tension, {}, upper_grip, sample, stamp}));
}

std::uint64_t write_run_bag(const std::string& file, const std::string& folder, const Method& method,
                            const std::string& beside) {
  SamplesReader samples(folder);
  RunBag bag(file, method, beside);
  Record record;
  while (samples.next(record)) bag.add(record);
  bag.close(samples.end().value_or(TestEnd()));
  return bag.messages();
}

}  // namespace knot_utm
