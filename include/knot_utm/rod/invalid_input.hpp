#pragma once

#include <stdexcept>
#include <string>

namespace knot_utm {

/// Foreign text as a message shows it: on one line, without control characters, its end left out where it is longer
/// than a line can say.
std::string shown(const std::string& text);

/// Input outside what is allowed. `what()` is one line: "file: key: value is not allowed: allowed", the file left
/// out where it is not known, each part as `shown`. Whoever read the input from a file adds its name with `in_file`.
struct InvalidInput : std::runtime_error {
  InvalidInput(const std::string& key_, const std::string& value_, const std::string& allowed_)
      : InvalidInput(std::string(), key_, value_, allowed_) {}

  InvalidInput(const std::string& file_, const std::string& key_, const std::string& value_,
               const std::string& allowed_)
      : std::runtime_error((file_.empty() ? "" : shown(file_) + ": ") + shown(key_) + ": " + shown(value_) +
                           " is not allowed: " + allowed_),
        file(file_),
        key(key_),
        value(value_),
        allowed(allowed_) {}

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
