#pragma once

#include <vector>

#include "knot_utm/contact/candidates.hpp"
#include "knot_utm/contact/centreline_curve.hpp"
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

/// The feet (closest-point projections) of points a on the smooth centreline: places of a segment at which the distance
/// from a has a minimum, F'(u) = -(a - c(u)).c'(u) = 0 with F' increasing. F' is a cubic in u. The segments that
/// FootSieve leaves are examined four at a time.
class FootSearch {
 public:
  struct Foot {
    Lanes x;      ///< a - c(u), and its length [m]
    double u;     ///< [-]
    int point;    ///< 2 n or 2 n + 1: first or second point of the n-th look
    int segment;  ///< that the foot stands on
  };

  /// Feet further away than `reach` are of no interest [m].
  FootSearch(Eigen::Index nodes, double reach);

  /// Begins a search without points on the present centreline; feet are searched on these segments only.
  void begin(const Points& position, const std::vector<int>& segments);
  /// Begins to follow the feet of the last search to the present centreline. The same number of points is to be added.
  void begin_to_follow(const Points& position, const std::vector<int>& segments);
  /// Adds two points, whose feet are followed.
  void add(const Lanes& first, const Lanes& second);
  /// Adds two points, whose candidates are the segments of these runs.
  void look(const Lanes& first, const Lanes& second, const Candidates::Run* begin, const Candidates::Run* end);
  /// Finds the feet of all points, in the order of the points' numbers, then along the rod.
  void find();
  /// Follows the feet of the last search, each to the minimum near it on its segment. Two steps of Halley's method
  /// leave an error of the ninth order in the motion since the last search. False where a foot leaves its segment, or
  /// is a minimum no longer; then the feet are of no use.
  bool follow();
  const std::vector<Foot>& feet() const { return feet_; }
  std::vector<Foot>& feet() { return feet_; }

  const SegmentParabola& parabola(int segment) const { return parabola_[static_cast<std::size_t>(segment)]; }

 private:
  struct Pair {
    int point, segment;
  };

  struct Four;

  Four four(const Pair* pairs, std::size_t count) const;
  /// Keeps only the pairs that may be within reach.
  void leave_near_ones();
  void find_feet(const Pair* pairs, std::size_t count);
  /// Follows up to four of the feet.
  bool follow_feet(Foot* feet, std::size_t count);

  double reach_;
  FootSieve sieve_;
  std::vector<SegmentParabola> parabola_;  // of the segments asked for
  std::vector<Lanes> points_;              // two a look
  std::vector<Pair> pairs_;                // what the sieve left, then what is near
  std::vector<Foot> feet_;
};

}  // namespace knot_utm
