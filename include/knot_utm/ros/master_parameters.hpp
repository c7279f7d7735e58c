#pragma once

#include <XmlRpcValue.h>

#include <optional>
#include <string>

namespace knot_utm {

/// Parameters of the ROS master, which is not waited for: roscpp's own setParam waits for ever for a master that died,
/// and does nothing once ROS is being shut down. `name`: resolved.

/// Whether the master answers.
bool master_answers();

/// False where the master does not answer.
bool set_on_master(const std::string& name, const XmlRpc::XmlRpcValue& value);

/// False where the parameter is not set, or the master does not answer.
bool delete_on_master(const std::string& name);

/// Empty where the parameter is not set, or the master does not answer.
std::optional<XmlRpc::XmlRpcValue> get_from_master(const std::string& name);

}  // namespace knot_utm
