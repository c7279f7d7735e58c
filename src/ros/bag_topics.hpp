#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <string>

#include "knot_utm/numeric/invalid_input.hpp"

namespace knot_utm {

/// What the bag calls a topic of ours, under whatever namespace; empty: it does not have it. Throws InvalidInput where
/// it has two of them.
std::string topic_named(const rosbag::Bag& bag, const std::string& file, const std::string& name);

/// The same of one that must be there.
std::string required_topic(const rosbag::Bag& bag, const std::string& file, const std::string& name);

/// What is wrong with a bag that rosbag cannot open.
InvalidInput no_bag(const std::string& file, const std::string& why);

/// A message of a bag. Throws InvalidInput where it is not of this type, or of another version of it.
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
