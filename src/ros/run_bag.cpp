#include "knot_utm/ros/run_bag.hpp"

#include <knot_utm/TestStatus.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>

#include "knot_utm/program/phases.hpp"
#include "knot_utm/ros/conversions.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/tying/tied_loop.hpp"

namespace knot_utm {

RunBag::RunBag(const std::string& file, const Method& method, const Centreline& centreline)
    : bag_(file),
      method_(method_yaml(method)),
      radius_(method.material.radius),
      cuts_(centreline.cuts),
      grips_(method.specimen, method.machine, centreline, method.material),
      crosshead_(grips_.lower() + Vec3(0.0, 0.0, method.specimen.end_to_end)),
      picture_(method.specimen, method.machine, method.material),
      motion_(rollers_hold(method.specimen, method.machine), 0.0, marks_of(method.specimen, method.program)) {}

void RunBag::add(const Record& record) {
  const Command& command = record.command;
  const Sample& sample = record.answer;
  const ros::Time stamp = test_stamp(0.0, command.time);
  cell_readings_.add(record, [this](const Sample& reading) { add_reading(reading); });
  const Crosshead crosshead = to_message(command, kRun, stamp);
  bag_.write(names::kCrosshead, stamp, crosshead);
  bag_.write(names::kJointStates, stamp, to_joint_state(command, sample, stamp));
  motion_.add(sample);
  KnotState state = to_message(sample, kRun, stamp);
  put_motion(motion_, state);
  bag_.write(names::kKnotState, stamp, state);
  if (shape_is_due(command, sample) && record.shape.cols() > 0) {
    bag_.write(names::kKnotShape, stamp, to_message(record.shape, record.tension, radius_, crosshead));
    if (!begun_) {
      picture_.begin(record.shape, cuts_);
      std_msgs::String text;
      text.data = method_;
      bag_.write_latched(names::kMethod, stamp, text);
      bag_.write_latched(names::kColors, stamp, picture_.scale().bar());
      bag_.write_latched(names::kBodies, stamp, picture_.bodies());
    }
    begun_ = true;
    add_status(record, stamp);
    add_picture(record, stamp);
  }
}

void RunBag::close() {
  cell_readings_.end([this](const Sample& reading) { add_reading(reading); });
  bag_.close();
}

void RunBag::add_reading(const Sample& reading) {
  const bool parted = reading.status == BenchStatus::kBroken;
  if (parted && broken_) return;  // it answers every command with the same
  broken_ = parted;
  const ros::Time stamp = test_stamp(0.0, reading.time);
  if (parted) bag_.write(names::kKnotState, stamp, to_message(reading, kRun, stamp));
  bag_.write(names::kLoadCell, stamp, to_wrench(reading, stamp));
}

void RunBag::add_status(const Record& record, const ros::Time& stamp) {
  TestStatus status;
  status.header.stamp = stamp;
  status.state = TestStatus::RUNNING;
  status.run = kRun;
  status.sequence = record.command.sequence;
  status.phase = phase_name(record.command.phase);
  status.time = record.command.time;
  status.progress = status.time_left = status.real_time_factor = std::nan("");
  bag_.write_latched(names::kTestStatus, stamp, status);
}

void RunBag::add_picture(const Record& record, const ros::Time& stamp) {
  const Sample& sample = record.answer;
  // On a compliant frame the grip goes less far than the crosshead.
  const Vec3 upper_grip = grips_.upper(sample.end_to_end - grips_.end_to_end(0.0));
  tf2_msgs::TFMessage frames;
  for (const Transforms& some :
       {fixed_frames(grips_.lower(), stamp),
        moving_frames(crosshead_, sample.displacement, upper_grip, picture_.knot(record.shape), stamp)})
    frames.transforms.insert(frames.transforms.end(), some.begin(), some.end());
  bag_.write("tf", stamp, frames);
  bag_.write(names::kMarkers, stamp, picture_.draw({record.shape, record.tension, {}, upper_grip, sample, stamp}));
}

}  // namespace knot_utm
