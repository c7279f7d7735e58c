#pragma once

#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>

namespace knot_utm {

/// "file: cannot be written: why", the reason as the operating system gave it last.
inline std::runtime_error cannot_write(const std::string& file, int error = errno) {
  return std::runtime_error(file + ": cannot be written" +
                            (error == 0 ? "" : ": " + std::generic_category().message(error)));
}

}  // namespace knot_utm
