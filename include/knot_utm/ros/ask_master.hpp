#pragma once

#include <XmlRpcValue.h>

#include <optional>
#include <string>
#include <vector>

namespace knot_utm {

/// What the ROS master answers to a call such as "getParam", after the name of this node, with these words. Empty where
/// it refuses, or does not answer. It is not waited for, also where ROS is being shut down: roscpp's own setParam waits
/// for ever for a master that died, and does nothing once ROS is being shut down.
std::optional<XmlRpc::XmlRpcValue> ask_master(const char* call, const std::vector<XmlRpc::XmlRpcValue>& words = {});

}  // namespace knot_utm
