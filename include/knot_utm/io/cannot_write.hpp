#pragma once

#include <cerrno>
#include <stdexcept>
#include <string>

#include "knot_utm/numeric/invalid_input.hpp"

namespace knot_utm {

/// "cannot write FILE: no space left on device", the reason as the operating system gave it last.
struct CannotWrite : std::runtime_error {
  explicit CannotWrite(const std::string& file, int error_ = errno)
      : std::runtime_error("cannot write " + file + (error_ == 0 ? "" : ": " + reason_of(error_))), error(error_) {}

  /// Not the fault of whoever chose the place.
  bool out_of_room() const { return error == ENOSPC || error == EDQUOT || error == EFBIG; }

  int error;  ///< as errno has it
};

}  // namespace knot_utm
