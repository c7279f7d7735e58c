#include "knot_utm/words/yaml_lines.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "knot_utm/words/number.hpp"

namespace knot_utm {

std::string quoted(const std::string& value) {
  std::string result = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') result += '\\';
    result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return result + '"';
}

void YamlLines::number(const char* key, const std::optional<double>& value) {
  const bool known = value && !std::isnan(*value);
  numbers_.emplace_back(key, known ? value : std::nullopt);
  word(key, known ? format_yaml_number(*value + 0.0) : "null");  // never "-0"
}

void YamlLines::count(const char* key, const std::optional<std::uint64_t>& value) {
  numbers_.emplace_back(key, value ? std::optional<double>(static_cast<double>(*value)) : std::nullopt);
  word(key, value ? std::to_string(*value) : "null");
}

std::optional<double> YamlLines::value(const std::string& key) const {
  const auto found =
      std::find_if(numbers_.begin(), numbers_.end(), [&](const auto& number) { return number.first == key; });
  return found == numbers_.end() ? std::nullopt : found->second;
}

void YamlLines::flag(const char* key, const std::optional<bool>& value) {
  word(key, !value ? "null" : *value ? "true" : "false");
}

void YamlLines::word(const char* key, const std::string& value) { all_ += std::string(key) + ": " + value + "\n"; }

void YamlLines::text(const char* key, const std::string& value) { word(key, value.empty() ? "null" : quoted(value)); }

void YamlLines::numbers(const char* key, const std::vector<double>& values) {
  std::string all;
  bool known = false;
  for (const double value : values) {
    known |= std::isfinite(value);
    all += (all.empty() ? "" : ", ") + (std::isfinite(value) ? format_yaml_number(value) : "null");
  }
  word(key, known ? "[" + all + "]" : "null");
}

void YamlLines::list(const char* key, const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& entry : texts) all += (all.empty() ? "" : ", ") + quoted(entry);
  word(key, "[" + all + "]");
}

void YamlLines::explain_nulls(const std::function<std::string(const std::string& key)>& why) {
  const std::string null = ": null";
  std::istringstream lines(all_);
  std::string explained, line;
  while (std::getline(lines, line)) {
    const std::size_t key = line.size() < null.size() ? 0 : line.size() - null.size();
    const std::string reason = line.substr(key) == null ? why(line.substr(0, key)) : "";
    explained += line + (reason.empty() ? "" : "  # " + reason) + "\n";
  }
  all_ = explained;
}

}  // namespace knot_utm
