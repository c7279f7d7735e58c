#pragma once

#include <vector>

#include "knot_utm/contact/centreline_curve.hpp"
#include "knot_utm/contact/foot_sieve.hpp"

namespace knot_utm {

/// The feet of points on the smooth centreline: where their distance from a segment is least within it, by
/// F'(u) = -(a - c(u)).c'(u) = 0 rising, a cubic in u. Segments that FootSieve leaves are looked at four at a time.
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

  /// Forgets all points. The centreline as it stands now; feet will be looked for on these segments only.
  void begin(const Points& position, const std::vector<int>& segments);
  /// Two points that have the segments of these runs as candidates.
  void look(const Lanes& first, const Lanes& second, const Candidates::Run* begin, const Candidates::Run* end);
  /// Of all points, ascending in their number, then along the rod.
  void find();
  const std::vector<Foot>& feet() const { return feet_; }

  const SegmentParabola& parabola(int segment) const { return parabola_[static_cast<std::size_t>(segment)]; }

 private:
  struct Pair {
    int point, segment;
  };

  struct Four;

  Four four(const Pair* pairs, std::size_t count) const;
  /// Of the pairs, those that may be within reach.
  void leave_near_ones();
  void find_feet(const Pair* pairs, std::size_t count);

  double reach_;
  FootSieve sieve_;
  std::vector<SegmentParabola> parabola_;  // of the segments asked for
  std::vector<Lanes> points_;              // two a look
  std::vector<Pair> pairs_;                // what the sieve left, then what is near
  std::vector<Foot> feet_;
};

}  // namespace knot_utm
