#pragma once

#include <stdexcept>
#include <string>

namespace knot_utm {

/// Input outside what is allowed. `what()` is one line; whoever read the input from a file adds its name.
struct InvalidInput : std::runtime_error {
  InvalidInput(std::string key_, std::string value_, std::string allowed_)
      : std::runtime_error(key_ + ": " + value_ + " is not allowed: " + allowed_),
        key(std::move(key_)),
        value(std::move(value_)),
        allowed(std::move(allowed_)) {}
  std::string key;      ///< dotted path, e.g. "specimen.edge_length"
  std::string value;    ///< as given
  std::string allowed;  ///< e.g. "0.0005 to 0.0064 m (at most twice the radius)"
};

}  // namespace knot_utm
