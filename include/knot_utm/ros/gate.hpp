#pragma once

#include <ros/ros.h>

#include <memory>
#include <set>
#include <string>

namespace knot_utm {

/// Subscribes to a topic, and ignores what any node but its rightful publisher says there. Both names are relative to
/// the namespace of the subscriber. A warning is printed once for each stranger.
template <class Message, class Node>
ros::Subscriber subscribe_gated(ros::NodeHandle& handle, const char* topic, const char* publisher, std::uint32_t queue,
                                void (Node::*take)(const boost::shared_ptr<const Message>&), Node* node) {
  using Event = const ros::MessageEvent<const Message>&;
  const std::string rightful = handle.resolveName(publisher);
  const auto strangers = std::make_shared<std::set<std::string>>();
  const boost::function<void(Event)> callback = [=](Event event) {
    const std::string& from = event.getPublisherName();
    if (from == rightful) return (node->*take)(event.getMessage());
    if (strangers->insert(from).second)
      ROS_WARN("messages on %s from %s are ignored: only %s may publish there", topic, from.c_str(), rightful.c_str());
  };
  ros::SubscribeOptions options;
  options.initByFullCallbackType<Event>(topic, queue, callback);
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  return handle.subscribe(options);
}

}  // namespace knot_utm
