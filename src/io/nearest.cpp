#include "knot_utm/io/nearest.hpp"

#include <algorithm>
#include <numeric>

namespace knot_utm {
namespace {

/// Letters to be put in, taken out or replaced (Levenshtein's distance).
std::size_t changes(const std::string& from, const std::string& to) {
  if (to.rfind(from, 0) == 0) return 1;  // cut short
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= from.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t replaced = diagonal + (from[i - 1] == to[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
  const auto found = std::min_element(known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
    return changes(word, a) < changes(word, b);
  });
  return found == known.end() ? std::string() : *found;
}

}  // namespace knot_utm
