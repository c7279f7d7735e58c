#pragma once

#include <vector>

namespace knot_utm {

/// The structure of a symmetric matrix, as compressed rows: row i has an entry beside the diagonal in the columns
/// list[begin[i]] to list[begin[i + 1] - 1], ascending, and column i in the same rows.
struct Neighbours {
  std::vector<int> begin = {0}, list;

  int nodes() const { return static_cast<int>(begin.size()) - 1; }
};

}  // namespace knot_utm
