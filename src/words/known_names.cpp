#include "knot_utm/words/known_names.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace knot_utm {
namespace {

constexpr std::size_t kLongest = 64;  // no name is longer

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// The optimal string alignment distance: each swap of neighbours, addition, omission or replacement counts one.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = above;
    above = row;
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

/// How many mistakes a name of this length may have: more would make it another name.
std::size_t mistakes(std::size_t length) { return length < 3 ? 0 : length < 6 ? 1 : length < 10 ? 2 : 3; }

}  // namespace

std::string listed(const std::vector<std::string>& names, const char* before_last) {
  std::string all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) all += i + 1 == names.size() ? before_last : ", ";
    all += names[i];
  }
  return all;
}

std::string nearest_name(const std::string& given, const std::vector<std::string>& known) {
  if (given.size() > kLongest) return {};
  std::string nearest;
  std::size_t fewest = mistakes(given.size()) + 1;
  for (const std::string& name : known) {
    const std::size_t apart = distance(lower(given), lower(name));
    if (apart < fewest) {
      fewest = apart;
      nearest = name;
    }
  }
  return nearest;
}

}  // namespace knot_utm
