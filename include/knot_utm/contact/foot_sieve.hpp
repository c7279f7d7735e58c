#pragma once

#include <vector>

#include "knot_utm/contact/candidates.hpp"
#include "knot_utm/numeric/lanes.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// A cheap test for feet of a point a on the smooth centreline: which segments may hold a place where F'(u) = -(a -
/// c(u)).c'(u) rises through zero. It leaves one or two segments of each strand and loses no foot.
///
/// On a segment c(u) = m + t u + k u^2/2, with m the middle of an edge and t the edge, F' is a cubic. Its control
/// values follow from its values g_0, g_1 at the ends, which are middles of edges and belong to two segments each:
///
///     g_0,   (2 g_0 + g_1 - A)/3,   (g_0 + 2 g_1 - B)/3,   g_1,      A = (3 t.k + k.k)/2,  B = 3/2 t.k + k.k
///
/// F' does not rise through zero where all four values have the same sign, nor where g_1 < 0 <= g_0, as F''' >= 0. So
/// there is no foot where
///
///     g_0 >= max(A/2, B, 0)      or      g_1 < min(A, B/2, 0).
class FootSieve {
 public:
  explicit FootSieve(Eigen::Index nodes);

  /// Takes the present centreline.
  void set_centreline(const Points& position);

  /// Sieves the segments of these runs for two points at once, because both points of a segment have the same
  /// candidates.
  void sieve(const Lanes& first, const Lanes& second, const Candidates::Run* begin, const Candidates::Run* end);

  /// What was left for point 0 or 1, in the order of the runs.
  const int* begin(int point) const { return left_[point].data(); }
  const int* end(int point) const { return left_[point].data() + count_[point]; }

 private:
  /// Four edges and the segments that end on them, side by side.
  struct FourEdges {
    Lanes e[3] = {};         // [m]
    Lanes me = {};           // m.e [m^2]
    Lanes least_begin = {};  // no foot where F' begins here or above [m^2]
    Lanes least_end = {};    // no foot where it ends below [m^2]

    /// F' at the middles of the edges: -(a - m).e
    Lanes slope(const Lanes& a) const { return me - a[0] * e[0] - a[1] * e[1] - a[2] * e[2]; }
  };

  std::vector<FourEdges> edges_;
  std::vector<int> left_[2];
  std::size_t count_[2] = {0, 0};
};

}  // namespace knot_utm
