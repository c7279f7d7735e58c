#include "out_of_range.hpp"

#include <cmath>
#include <sstream>

#include "knot_utm/numeric/number.hpp"

namespace knot_utm {

namespace {

/// The number that a limit ends with: 0.0381 of "at least 12 radii, 0.0381 m". Empty: it has none.
std::string last_number(const std::string& limit) {
  std::istringstream words(limit.substr(0, limit.find(':')));
  std::string found;
  for (std::string word; words >> word;)
    if (parse_number(word)) found = word;
  return found;
}

}  // namespace

InvalidInput narrowed(const OutOfRange& wrong, const std::function<void(const std::string& override)>& attempt) {
  std::string here;
  // The limit that a value says, or an empty text.
  const auto limit_at = [&](const std::string& value) -> std::string {
    try {
      attempt(wrong.key + "=" + value);
    } catch (const InvalidInput& inner) {
      const bool says_a_range = std::string(inner.what()).find(", but must be " + inner.allowed) != std::string::npos;
      if (inner.key == wrong.key && says_a_range && here.find(inner.allowed) == std::string::npos) return inner.allowed;
    }
    return {};
  };
  for (const double end : {wrong.min, wrong.max}) {
    std::string value = std::isfinite(end) ? format_yaml_number(end) : "";
    // A value at the first limit may be refused by a second one.
    for (int i = 0; i < 2 && !value.empty(); ++i) {
      const std::string limit = limit_at(value);
      if (!limit.empty()) here += (here.empty() ? ", and here " : " and ") + limit;
      value = limit.rfind("at ", 0) == 0 ? last_number(limit) : "";
    }
  }
  return {wrong.file, wrong.key, wrong.value, wrong.allowed + here};
}

}  // namespace knot_utm
