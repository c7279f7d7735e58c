#pragma once

#include <ros/message_traits.h>
#include <rosbag/bag.h>

#include <boost/make_shared.hpp>
#include <cstdint>
#include <memory>
#include <string>

#include "knot_utm/run/run_folder.hpp"

namespace knot_utm {

/// Writes a bag. All functions throw CannotWrite. None ends the process when the disk is full, as the destructor of
/// rosbag::Bag does.
class BagWriter {
 public:
  explicit BagWriter(const std::string& file) : file_(file) {
    constexpr std::uint32_t kChunk =
        64 * 1024;  // small enough to be read in pieces, large enough for few chunks [bytes]
    try {
      bag_ = std::make_unique<rosbag::Bag>(file_, rosbag::bagmode::Write);
    } catch (const rosbag::BagException&) {
      throw CannotWrite(file_);
    }
    bag_->setChunkThreshold(kChunk);
  }
  ~BagWriter() {
    try {
      close();
    } catch (const std::runtime_error&) {
      // Who wants to know closes it.
    }
  }
  BagWriter(const BagWriter&) = delete;
  BagWriter& operator=(const BagWriter&) = delete;

  /// Writes a message. `topic`: name without a leading slash.
  template <class Message>
  void write(const std::string& topic, const ros::Time& stamp, const Message& message,
             const boost::shared_ptr<ros::M_string>& header = nullptr) {
    try {
      bag_->write("/" + topic, stamp, message, header);
    } catch (const rosbag::BagException&) {
      throw CannotWrite(file_);
    }
    ++messages_;
  }

  /// The same for a latched topic, whose last message `rosbag play` keeps for later subscribers.
  template <class Message>
  void write_latched(const std::string& topic, const ros::Time& stamp, const Message& message) {
    const auto header = boost::make_shared<ros::M_string>();
    (*header)["latching"] = "1";
    (*header)["type"] = ros::message_traits::datatype<Message>();
    (*header)["md5sum"] = ros::message_traits::md5sum<Message>();
    (*header)["message_definition"] = ros::message_traits::definition<Message>();
    write(topic, stamp, message, header);
  }

  /// Writes the index, without which the file cannot be read.
  void close() {
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

  std::uint64_t messages() const { return messages_; }  ///< number of messages written so far

 private:
  std::string file_;
  std::unique_ptr<rosbag::Bag> bag_;  ///< null once closed
  std::uint64_t messages_ = 0;
};

}  // namespace knot_utm
