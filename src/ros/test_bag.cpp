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
  bag_.write(names::kCrosshead, stamp, to_message(command, kRun, stamp));
  bag_.write(names::kJointStates, stamp, to_joint_state(command, sample, stamp));
  motion_.add(sample);
  KnotState state = to_message(sample, kRun, stamp);
  state.motion_pattern = motion_pattern_name(motion_.pattern());
  bag_.write(names::kKnotState, stamp, state);
  if (command.read_cell) bag_.write(names::kLoadCell, stamp, to_wrench(sample, stamp));
  if (shape_is_due(command) && record.shape.cols() > 0) {
    KnotShape message = to_message(record.shape, record.tension, radius_);
    message.header.stamp = stamp;
    message.run = kRun;
    message.sequence = command.sequence;
    bag_.write(names::kKnotShape, stamp, message);
  }
}

}  // namespace knot_utm
