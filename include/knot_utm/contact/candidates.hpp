#pragma once

#include <vector>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/lanes.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

struct RodProperties;

/// Contacts are followed, from zero force on, up to this gap [h].
inline constexpr double kReachMargin = 0.3;

/// Length of rod within which a strand does not touch itself [m]: half a turn around a circle of its own radius, pi h.
/// While no bend is sharper than 1/h, two places that lie s < pi h apart along the rod are at least as far apart as the
/// chord 2 h sin(s/(2h)) of that circle (Schur), and where two strands are nearest to each other, more than pi h of rod
/// lies between.
inline double least_loop(double radius) {
  constexpr double kPi = 3.14159265358979323846;
  return kPi * radius;
}

/// Which segments of the rod may touch which. Segment i, 1 <= i <= N-2, is the piece of centreline around node i, out
/// to the middles of the edges that meet there, as long as they now are. The list holds every pair closer than `reach`
/// plus a margin. It stays valid until a node has moved by half of the margin. A step may move nodes further;
/// TunnellingSearch then excludes that a strand passes through another one unseen.
class Candidates {
 public:
  struct Run {
    int first;  ///< consecutive segments first..last
    int last;
  };

  /// `reach` is the distance of centrelines that must be found [m]; pairs closer than `exclusion` along the rod
  /// never count [m]. `exclusion` is that of the rod's own material, and in proportion to the radius that of another.
  Candidates(const RodProperties& rod, double reach, double margin, double exclusion);

  /// Rebuilds the list where something moved far enough; true if it did.
  bool refresh(const Points& position);

  /// Neighbours of segment i as runs of consecutive segments.
  const Run* begin(int segment) const { return runs_.data() + begin_[static_cast<std::size_t>(segment)]; }
  const Run* end(int segment) const { return runs_.data() + begin_[static_cast<std::size_t>(segment) + 1]; }

  /// Segments that have neighbours, ascending.
  const std::vector<int>& segments() const { return segments_; }

  /// Of the rope that a segment belongs to; two ropes are further apart along the rod than any.
  double exclusion(int segment) const { return segment < first_of_other_ ? exclusion_ : other_exclusion_; }

  /// From now on the rod is cut at this edge, too, and the two segments that reach into it touch nothing.
  void part(int edge);

  /// Saves or loads the positions for which the list was built; the list follows from them.
  void state(Archive& archive);

 private:
  struct Ball {
    Vec3 centre;
    double radius;
  };
  /// Four balls side by side.
  struct Balls {
    Lanes centre[3];
    Lanes radius;

    void set(std::size_t lane, const Ball& ball);
    Ball get(std::size_t lane) const;
    /// A ball around all four.
    Ball around() const;
    /// Which of them come nearer to a place than `limit`, as a mask. Balls that are infinitely far away never do.
    auto within(double limit, const Vec3& from) const {
      const Lanes x = centre[0] - from[0], y = centre[1] - from[1], z = centre[2] - from[2], far = limit + radius;
      return x * x + y * y + z * z < far * far;
    }
  };

  void build(const Points& position);
  void measure(const Points& position);
  void set_balls(const Points& position);
  /// Finds which fours of segments are near to that four, from the ball around all of them downwards.
  void find_around(int four);
  /// Whether the rod is drawn out so far that it cannot come back to itself.
  bool is_taut(const Points& position) const;

  double reach_, margin_, exclusion_, other_exclusion_;
  int first_of_other_;         // RodProperties::first_of_other
  Eigen::VectorXd arclength_;  // of the nodes
  Eigen::VectorXd size_;       // of segment i about its node [m]
  Points built_at_;
  bool whole_ = true;          // no edge is cut
  std::vector<char> touches_;  // whether a segment may touch anything: none at the ends or at a cut
  std::vector<std::size_t> begin_;
  std::vector<Run> runs_;
  std::vector<int> segments_;
  // Segments lie in balls about their nodes, four in a row of these in a larger ball, and so on up to one around all.
  // Segments that touch nothing are infinitely far away.
  std::vector<std::vector<Balls>> levels_;  // [level][i]: the four that ball i of the next level is around
  std::vector<Lanes> four_arclengths_;      // of the nodes
  std::vector<Run> around_;  // fours of segments near to the present four; a member so that its memory is reused, as is
  std::vector<Run> larger_around_;  // that of the level above
};

}  // namespace knot_utm
