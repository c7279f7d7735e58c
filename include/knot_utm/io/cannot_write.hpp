#pragma once

#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>

namespace knot_utm {

/// "file: cannot be written: why", the reason as the operating system gave it last.
struct CannotWrite : std::runtime_error {
  explicit CannotWrite(const std::string& file, int error_ = errno)
      : std::runtime_error(file + ": cannot be written" +
                           (error_ == 0 ? "" : ": " + std::generic_category().message(error_))),
        error(error_) {}

  /// Not the fault of whoever chose the place.
  bool out_of_room() const { return error == ENOSPC || error == EDQUOT || error == EFBIG; }

  int error;  ///< as errno has it
};

}  // namespace knot_utm
