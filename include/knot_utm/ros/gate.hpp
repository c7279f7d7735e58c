#pragma once

#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <string>

namespace knot_utm {

/// Size of a queue that loses nothing: between the nodes of a test every message arrives while their connection lasts.
inline constexpr std::uint32_t kNoLimit = 0;

/// Subscribes to a topic, and ignores what any node but its rightful publisher says there. Both names are relative to
/// the namespace of the subscriber. A warning is printed once for each stranger.
template <class Message, class Node>
ros::Subscriber subscribe_gated(ros::NodeHandle& handle, const char* topic, const char* publisher,
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
  options.initByFullCallbackType<Event>(topic, kNoLimit, callback);
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  return handle.subscribe(options);
}

/// Advertises a topic on which nothing is lost. `change` is told whether the node `listener`, which that is for, is
/// connected: from then on every message arrives there.
template <class Message>
ros::Publisher advertise_watched(ros::NodeHandle& handle, const char* topic, const char* listener,
                                 const std::function<void(bool)>& change, bool latched = false) {
  const auto links = std::make_shared<int>(0);
  const auto tell = [=, name = handle.resolveName(listener)](bool is_there) -> ros::SubscriberStatusCallback {
    return [=](const ros::SingleSubscriberPublisher& subscriber) {
      if (subscriber.getSubscriberName() != name) return;
      *links += is_there ? 1 : -1;
      change(is_there);
      if (!is_there && *links > 0) change(true);  // it has connected anew before the loss was seen
    };
  };
  return handle.advertise<Message>(topic, kNoLimit, tell(true), tell(false), ros::VoidConstPtr(), latched);
}

/// Offers a service of the operator. `asked` does it, and says what is to be said; false: it is refused.
inline ros::ServiceServer offer(ros::NodeHandle& handle, const char* name,
                                const std::function<bool(std::string& said)>& asked) {
  using Trigger = std_srvs::Trigger;
  return handle.advertiseService<Trigger::Request, Trigger::Response>(
      name, [=](Trigger::Request& /*request*/, Trigger::Response& response) {
        response.success = static_cast<std::uint8_t>(asked(response.message));
        return true;
      });
}

/// Why a command, or its record, is not taken.
inline std::string out_of_order(std::uint64_t came, std::uint64_t expected) {
  return "command " + std::to_string(came) + " came where " + std::to_string(expected) + " was expected";
}

}  // namespace knot_utm
