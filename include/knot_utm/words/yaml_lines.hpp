#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace knot_utm {

/// A text in quotes, for YAML and JSON; characters that are no text are blanks.
std::string quoted(const std::string& text);

/// A YAML map, written as one "key: value" line after the other. Values that are missing or NaN are null.
class YamlLines {
 public:
  void number(const char* key, const std::optional<double>& value);
  void count(const char* key, const std::optional<std::uint64_t>& value);
  void flag(const char* key, const std::optional<bool>& value);
  void word(const char* key, const std::string& value);  ///< written without quotes
  void text(const char* key, const std::string& value);  ///< written in quotes; an empty one is null
  /// a list of numbers, null for each that is NaN; null if none is a number
  void numbers(const char* key, const std::vector<double>& values);
  void list(const char* key, const std::vector<std::string>& texts);

  /// Appends to each null a comment with its reason, where `why` returns one for that key.
  void explain_nulls(const std::function<std::string(const std::string& key)>& why);

  const std::string& all() const { return all_; }

  /// value of a number or count; empty: null, or no such key
  std::optional<double> value(const std::string& key) const;

 private:
  std::string all_;
  std::vector<std::pair<std::string, std::optional<double>>> numbers_;
};

}  // namespace knot_utm
