#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace knot_utm {

/// "a, b or c"; other words than " or " may stand before the last one.
std::string listed(const std::vector<std::string>& names, const char* before_last = " or ");

/// The known name that a misspelt one most likely means: the fewest letters added, left out, replaced or swapped, upper
/// and lower case alike. Empty where none is near, or the text is too long to be a name.
std::string nearest_name(const std::string& given, const std::vector<std::string>& known);

/// Text from outside as a message shows it: on one line, without control characters, shortened where it is too long for
/// a line.
std::string shown(const std::string& text);

/// The operating system's reason for an error, as errno has it, in lower case: "permission denied".
std::string reason_of(int error);

/// Input outside what is allowed. `what()` is one line, a sentence that says what is wrong, where, and what is allowed.
/// Its most frequent form is "KEY is VALUE, but must be ALLOWED"; the functions below make the others. Whoever read the
/// input from a file adds "FILE: " with `in_file`. What comes from outside is `shown`.
struct InvalidInput : std::runtime_error {
  /// "specimen.turns is 7, but must be 1 to 4".
  InvalidInput(const std::string& key, const std::string& value, const std::string& allowed);
  InvalidInput(const std::string& file, const std::string& key, const std::string& value, const std::string& allowed);

  /// "material is missing: give a name (green_vps, nylon) or a map".
  static InvalidInput missing(const std::string& key, const std::string& give);

  /// "specimen.prelaod is no key of a method; did you mean specimen.preload?", or the known keys where none is near.
  /// `section` is the dotted path of the map that the key stands in, empty for a file's top.
  static InvalidInput unknown_key(const std::string& section, const std::string& key,
                                  const std::vector<std::string>& known, const std::string& of);

  /// "material is "nyln", but must be ALLOWED; did you mean nylon?", without the question where no name is near.
  static InvalidInput unknown_name(const std::string& key, const std::string& value, const std::string& allowed,
                                   const std::vector<std::string>& known);

  /// "cannot read FILE: no such file"; looks for the reason itself. Where another file's key names it: "KEY: cannot
  /// ...".
  static InvalidInput cannot_read(const std::string& file, const std::string& key = "");

  /// "cannot write FILE: permission denied", for a place that the user chose.
  static InvalidInput cannot_write(const std::string& key, const std::string& file, int error);

  /// Any other sentence about this key, with nothing foreign in it that has not been `shown`.
  static InvalidInput sentence(const std::string& key, const std::string& text);

  /// The same with a file's name, unless it has one already or is about an argument ("--out"), which stands in no file.
  InvalidInput in_file(const std::string& name) const;

  std::string file;  ///< where the input stands; empty: not known
  std::string key;   ///< dotted path, e.g. "specimen.edge_length"

 private:
  struct Place {
    std::string file, key;
  };
  InvalidInput(const Place& place, const std::string& line);
};

}  // namespace knot_utm
