#include "knot_utm/ros/test_bag.hpp"

#include <stdexcept>

#include "knot_utm/io/cannot_write.hpp"
#include "knot_utm/ros/conversions.hpp"
#include "knot_utm/ros/names.hpp"

namespace knot_utm {
namespace {

/// Small enough to be read in pieces, large enough for few chunks [bytes].
constexpr std::uint32_t kChunk = 64 * 1024;

/// The bag holds one test, whatever number it had in the life of the node that ran it.
constexpr std::uint32_t kRun = 1;

}  // namespace

TestBag::TestBag(const std::string& file, const Method& method) : file_(file), radius_(method.material.radius) {
  try {
    bag_ = std::make_unique<rosbag::Bag>(file_, rosbag::bagmode::Write);
  } catch (const rosbag::BagException&) {
    throw CannotWrite(file_);
  }
  bag_->setChunkThreshold(kChunk);
}

TestBag::~TestBag() {
  try {
    close();
  } catch (const std::runtime_error&) {
    // Who wants to know closes it.
  }
}

void TestBag::add(const Record& record) {
  const Command& command = record.command;
  const Sample& sample = record.answer;
  const ros::Time stamp = test_stamp(0.0, command.time);
  write(names::kCrosshead, stamp, to_message(command, kRun, stamp));
  write(names::kJointStates, stamp, to_joint_state(command, sample, stamp));
  motion_.add(sample);
  KnotState state = to_message(sample, kRun, stamp);
  state.motion_pattern = motion_pattern_name(motion_.pattern());
  write(names::kKnotState, stamp, state);
  if (command.read_cell) write(names::kLoadCell, stamp, to_wrench(sample, stamp));
  if (shape_is_due(command) && record.shape.cols() > 0) {
    KnotShape message = to_message(record.shape, record.tension, radius_);
    message.header.stamp = stamp;
    message.run = kRun;
    message.sequence = command.sequence;
    write(names::kKnotShape, stamp, message);
  }
}

void TestBag::close() {
  if (!bag_) return;
  try {
    bag_->close();
    bag_.reset();
  } catch (const rosbag::BagException&) {
    // Its destructor would try once more, and end the process.
    static_cast<void>(bag_.release());
    throw CannotWrite(file_);
  }
}

template <class Message>
void TestBag::write(const std::string& topic, const ros::Time& stamp, const Message& message) {
  try {
    bag_->write("/" + topic, stamp, message);
  } catch (const rosbag::BagException&) {
    throw CannotWrite(file_);
  }
  ++messages_;
}

}  // namespace knot_utm
