#pragma once

#include <set>
#include <utility>
#include <vector>

#include "knot_utm/solver/neighbours.hpp"

namespace knot_utm {

/// Of the coupled nodes (i, j), i != j, in any order and number.
inline Neighbours coupled(int nodes, const std::vector<std::pair<int, int>>& pairs) {
  std::vector<std::set<int>> rows(static_cast<std::size_t>(nodes));
  for (const auto& [i, j] : pairs) {
    rows[static_cast<std::size_t>(i)].insert(j);
    rows[static_cast<std::size_t>(j)].insert(i);
  }
  Neighbours out;
  for (const std::set<int>& row : rows) {
    out.list.insert(out.list.end(), row.begin(), row.end());
    out.begin.push_back(static_cast<int>(out.list.size()));
  }
  return out;
}

}  // namespace knot_utm
