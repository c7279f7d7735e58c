#pragma once

#include <ros/ros.h>

#include <boost/make_shared.hpp>
#include <chrono>
#include <memory>
#include <string>

namespace knot_utm {

/// Says what is wrong on a topic: at most one line in five seconds, by a clock that nobody else sets.
class TopicWarning {
 public:
  explicit TopicWarning(std::string topic) : topic_(std::move(topic)) {}
  void say(const std::string& publisher, const std::string& fault);

 private:
  std::string topic_;
  std::chrono::steady_clock::time_point said_;
  bool silent_so_far_ = true;
};

/// Who may publish on a topic that a test hangs on, and how much at a time. What comes from elsewhere is ignored before
/// it is unpacked: the length of an array in it would be believed.
class Gate {
 public:
  /// `publisher`: full name of a node; `largest`: length of a message [bytes].
  Gate(const std::string& topic, std::string publisher, std::uint32_t largest);

  /// Whether to take a message; a warning where not.
  bool admits(const std::string& publisher, std::uint32_t length);

 private:
  std::string publisher_;
  std::uint32_t largest_;
  TopicWarning warning_;
};

/// A topic as one node publishes it, both relative to the namespace of who subscribes.
struct Source {
  const char* topic;
  const char* publisher;
  std::uint32_t queue;    ///< [messages]
  std::uint32_t largest;  ///< message [bytes]
};

/// Unpacks only what the gate admits.
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

/// Subscribes to a topic as published by its rightful node only.
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
