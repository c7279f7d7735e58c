#pragma once

#include <ros/message_traits.h>
#include <rosbag/bag.h>

#include <boost/make_shared.hpp>
#include <cstdint>
#include <memory>
#include <string>

#include "knot_utm/io/cannot_write.hpp"

namespace knot_utm {

/// A bag as it is written. All of it throws CannotWrite, and nothing of it ends the process, as rosbag's own destructor
/// does where the disk is full.
class BagWriter {
 public:
  explicit BagWriter(const std::string& file);
  ~BagWriter();
  BagWriter(const BagWriter&) = delete;
  BagWriter& operator=(const BagWriter&) = delete;
  BagWriter(BagWriter&&) = delete;
  BagWriter& operator=(BagWriter&&) = delete;

  /// `topic` without its leading slash.
  template <class Message>
  void write(const std::string& topic, const ros::Time& stamp, const Message& message) {
    try {
      bag_->write("/" + topic, stamp, message);
    } catch (const rosbag::BagException&) {
      throw CannotWrite(file_);
    }
    ++messages_;
  }

  /// The same of a topic that is latched: `rosbag play` keeps its last message for whoever comes later.
  template <class Message>
  void write_latched(const std::string& topic, const ros::Time& stamp, const Message& message) {
    const auto header = boost::make_shared<ros::M_string>();
    (*header)["latching"] = "1";
    (*header)["type"] = ros::message_traits::datatype<Message>();
    (*header)["md5sum"] = ros::message_traits::md5sum<Message>();
    (*header)["message_definition"] = ros::message_traits::definition<Message>();
    try {
      bag_->write("/" + topic, stamp, message, header);
    } catch (const rosbag::BagException&) {
      throw CannotWrite(file_);
    }
    ++messages_;
  }

  void close();  ///< only then has the file an index, without which it cannot be read

  std::uint64_t messages() const { return messages_; }  ///< written so far

 private:
  std::string file_;
  std::unique_ptr<rosbag::Bag> bag_;  ///< none once closed
  std::uint64_t messages_ = 0;
};

}  // namespace knot_utm
