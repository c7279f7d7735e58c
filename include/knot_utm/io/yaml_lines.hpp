#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace knot_utm {

/// A YAML map, one "key: value" line after the other. What is not there, NaN too, is null.
class YamlLines {
 public:
  void number(const char* key, double value);
  void number(const char* key, const std::optional<double>& value);
  void count(const char* key, const std::optional<std::uint64_t>& value);
  void flag(const char* key, const std::optional<bool>& value);
  void word(const char* key, const std::string& value);              ///< as it is
  void text(const char* key, const std::string& value);              ///< quoted; empty is null
  void numbers(const char* key, const std::vector<double>& values);  ///< none, or one that is NaN, is null
  void list(const char* key, const std::vector<std::string>& texts);

  /// Behind each null a comment that says why, where `why` has something to say of that key.
  void explain_nulls(const std::function<std::string(const std::string& key)>& why);

  const std::string& all() const { return all_; }

  std::optional<double> value(const std::string& key) const;  ///< of a number or count; none: null, or not there

 private:
  std::string all_;
  std::vector<std::pair<std::string, std::optional<double>>> numbers_;
};

}  // namespace knot_utm
