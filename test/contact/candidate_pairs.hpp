#pragma once

#include <utility>
#include <vector>

#include "knot_utm/contact/candidates.hpp"

namespace knot_utm {

/// Each segment and each of its neighbours, in the order of the list: every pair stands there twice.
inline std::vector<std::pair<int, int>> neighbours_of(const Candidates& candidates) {
  std::vector<std::pair<int, int>> out;
  for (const int i : candidates.segments())
    for (const Candidates::Run* run = candidates.begin(i); run != candidates.end(i); ++run)
      for (int j = run->first; j <= run->last; ++j) out.emplace_back(i, j);
  return out;
}

/// The same pairs once, i < j.
inline std::vector<std::pair<int, int>> pairs_of(const Candidates& candidates) {
  std::vector<std::pair<int, int>> out;
  for (const auto& [i, j] : neighbours_of(candidates))
    if (i < j) out.emplace_back(i, j);
  return out;
}

}  // namespace knot_utm
