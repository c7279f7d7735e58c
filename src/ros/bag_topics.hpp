#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <string>

#include "knot_utm/numeric/invalid_input.hpp"

namespace knot_utm {

/// The name in a bag of one of the package's topics, in whatever namespace. Empty where the bag does not have it.
/// Throws InvalidInput where it has two of them.
std::string topic_named(const rosbag::Bag& bag, const std::string& file, const std::string& name);

/// The same for a topic that must be present. Throws InvalidInput where it is missing.
std::string required_topic(const rosbag::Bag& bag, const std::string& file, const std::string& name);

/// The error for a file that rosbag cannot open.
InvalidInput no_bag(const std::string& file, const std::string& why);

/// Deserialises a message of a bag. Throws InvalidInput where it is of another type, or of another version of this
/// type.
template <class Message>
boost::shared_ptr<Message> message_of(const rosbag::MessageInstance& instance, const std::string& file) {
  boost::shared_ptr<Message> message = instance.instantiate<Message>();
  if (!message)
    throw InvalidInput(
        file, "the type of topic " + instance.getTopic(), instance.getDataType() + " " + instance.getMD5Sum(),
        std::string(ros::message_traits::datatype<Message>()) + " " + ros::message_traits::md5sum<Message>());
  return message;
}

}  // namespace knot_utm
