#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace knot_utm {

/// Input outside what is allowed. `what()` is one line: "file: key: value is not allowed: allowed", the file left
/// out where it is not known. Whoever read the input from a file adds its name with `in_file`.
struct InvalidInput : std::runtime_error {
  InvalidInput(std::string key_, std::string value_, std::string allowed_)
      : InvalidInput(std::string(), std::move(key_), std::move(value_), std::move(allowed_)) {}

  InvalidInput(std::string file_, std::string key_, std::string value_, std::string allowed_)
      : std::runtime_error((file_.empty() ? "" : file_ + ": ") + key_ + ": " + value_ + " is not allowed: " + allowed_),
        file(std::move(file_)),
        key(std::move(key_)),
        value(std::move(value_)),
        allowed(std::move(allowed_)) {}

  /// The same with a file's name, unless it has one already.
  InvalidInput in_file(const std::string& name) const {
    return file.empty() ? InvalidInput(name, key, value, allowed) : *this;
  }

  std::string file;     ///< where the input stands; empty: not known
  std::string key;      ///< dotted path, e.g. "specimen.edge_length"
  std::string value;    ///< as given
  std::string allowed;  ///< e.g. "0.0005 to 0.0064 m (at most twice the radius)"
};

}  // namespace knot_utm
