#include "knot_utm/ros/bag_writer.hpp"

#include <stdexcept>

namespace knot_utm {
namespace {

/// Small enough to be read in pieces, large enough for few chunks [bytes].
constexpr std::uint32_t kChunk = 64 * 1024;

}  // namespace

BagWriter::BagWriter(const std::string& file) : file_(file) {
  try {
    bag_ = std::make_unique<rosbag::Bag>(file_, rosbag::bagmode::Write);
  } catch (const rosbag::BagException&) {
    throw CannotWrite(file_);
  }
  bag_->setChunkThreshold(kChunk);
}

BagWriter::~BagWriter() {
  try {
    close();
  } catch (const std::runtime_error&) {
    // Who wants to know closes it.
  }
}

void BagWriter::close() {
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

}  // namespace knot_utm
