#include "knot_utm/ros/test_bag.hpp"

#include "knot_utm/ros/conversions.hpp"
#include "knot_utm/ros/names.hpp"

namespace knot_utm {
namespace {

/// The bag holds one test, whatever number it had in the life of the node that ran it.
constexpr std::uint32_t kRun = 1;

}  // namespace

TestBag::TestBag(const std::string& file, const Method& method) : bag_(file), radius_(method.material.radius) {}

void TestBag::add(const Record& record) {
  const Command& command = record.command;
  const Sample& sample = record.answer;
  const ros::Time stamp = test_stamp(0.0, command.time);
  if (const Sample* reading = cell_reading(record)) add_reading(*reading, stamp);
  bag_.write(names::kCrosshead, stamp, to_message(command, kRun, stamp));
  bag_.write(names::kJointStates, stamp, to_joint_state(command, sample, stamp));
  motion_.add(sample);
  KnotState state = to_message(sample, kRun, stamp);
  state.motion_pattern = motion_pattern_name(motion_.pattern());
  bag_.write(names::kKnotState, stamp, state);
  if (shape_is_due(command) && record.shape.cols() > 0) {
    KnotShape message = to_message(record.shape, record.tension, radius_);
    message.header.stamp = stamp;
    message.run = kRun;
    message.sequence = command.sequence;
    bag_.write(names::kKnotShape, stamp, message);
  }
}

/// `answered`: stamp of the command. A rod parts between two.
void TestBag::add_reading(const Sample& reading, const ros::Time& answered) {
  const bool parted = reading.status == BenchStatus::kBroken;
  if (parted && broken_) return;  // it answers every command with the same
  broken_ = parted;
  const ros::Time stamp = parted ? test_stamp(0.0, reading.time) : answered;
  if (parted) bag_.write(names::kKnotState, stamp, to_message(reading, kRun, stamp));
  bag_.write(names::kLoadCell, stamp, to_wrench(reading, stamp));
}

}  // namespace knot_utm
