#pragma once

#include <functional>
#include <string>

namespace knot_utm {

/// Receives lines about what was read, which a user should see.
using Tell = std::function<void(const std::string& line)>;

}  // namespace knot_utm
