#pragma once

#include <ros/ros.h>

#include <boost/make_shared.hpp>
#include <chrono>
#include <memory>
#include <string>

namespace knot_utm {

/// Prints warnings about messages of a topic, at most one line in five seconds. The time is that of a monotonic clock,
/// which nobody can set.
class TopicWarning {
 public:
  explicit TopicWarning(std::string topic) : topic_(std::move(topic)) {}
  void say(const std::string& publisher, const std::string& fault);

 private:
  std::string topic_;
  std::chrono::steady_clock::time_point said_;
  bool silent_so_far_ = true;
};

/// Restricts who may publish on a topic, and how long a message may be. A message that is not admitted is ignored
/// before it is deserialised, because deserialising trusts the lengths of arrays in it.
class Gate {
 public:
  /// `publisher`: full name of the only node that may publish. `largest`: largest length of a message [bytes].
  Gate(const std::string& topic, std::string publisher, std::uint32_t largest);

  /// Whether to accept a message. A warning is printed where not.
  bool admits(const std::string& publisher, std::uint32_t length);

 private:
  std::string publisher_;
  std::uint32_t largest_;
  TopicWarning warning_;
};

/// A topic and the node that publishes it. Both names are relative to the namespace of the subscriber.
struct Source {
  const char* topic;
  const char* publisher;
  std::uint32_t queue;    ///< length of the subscriber's queue [messages]
  std::uint32_t largest;  ///< largest message [bytes]
};

/// A subscription callback that deserialises only messages admitted by a gate.
template <class Message>
class GatedCallback : public ros::SubscriptionCallbackHelperT<const boost::shared_ptr<const Message>&> {
  using Base = ros::SubscriptionCallbackHelperT<const boost::shared_ptr<const Message>&>;

 public:
  GatedCallback(const typename Base::Callback& callback, Gate gate) : Base(callback), gate_(std::move(gate)) {}

  ros::VoidConstPtr deserialize(const ros::SubscriptionCallbackHelperDeserializeParams& params) override {
    const auto caller = params.connection_header->find("callerid");
    const std::string publisher = caller == params.connection_header->end() ? "" : caller->second;
    return gate_.admits(publisher, params.length) ? Base::deserialize(params) : ros::VoidConstPtr();
  }

 private:
  Gate gate_;
};

/// Subscribes to a topic, and accepts messages of its rightful node only.
template <class Message, class Node>
ros::Subscriber subscribe_gated(ros::NodeHandle& handle, const Source& source,
                                void (Node::*take)(const boost::shared_ptr<const Message>&), Node* node) {
  using Pointer = boost::shared_ptr<const Message>;
  const boost::function<void(const Pointer&)> callback = [take, node](const Pointer& message) {
    (node->*take)(message);
  };
  ros::SubscribeOptions options;
  options.init<Message>(source.topic, source.queue, callback);
  options.helper = boost::make_shared<GatedCallback<Message>>(
      callback, Gate(source.topic, handle.resolveName(source.publisher), source.largest));
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  return handle.subscribe(options);
}

}  // namespace knot_utm
