#pragma once

#include <cerrno>
#include <stdexcept>
#include <string>

#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {

/// A file that cannot be written. The message has the form "cannot write FILE: no space left on device", with the
/// reason that the operating system gave last (errno).
struct CannotWrite : std::runtime_error {
  explicit CannotWrite(const std::string& file, int error_ = errno)
      : std::runtime_error("cannot write " + file + (error_ == 0 ? "" : ": " + reason_of(error_))), error(error_) {}

  /// Whether the file did not fit: the disk is full, the quota is used up or the file is too large. Otherwise the
  /// folder was a wrong choice.
  bool out_of_room() const { return error == ENOSPC || error == EDQUOT || error == EFBIG; }

  int error;  ///< value of errno
};

}  // namespace knot_utm
