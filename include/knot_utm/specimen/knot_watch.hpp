#pragma once

#include <optional>
#include <vector>

#include "knot_utm/record/sample.hpp"
#include "knot_utm/topology/knot_invariants.hpp"

namespace knot_utm {

/// Follows whether a specimen still is the knot that it began as.
///
/// Two strands cannot pass through each other, nor an end out of a coil, before some node has moved by the order of the
/// rod's radius h. So the topology is read where a node has moved by h since the reading before, and in between stays
/// what it was: a test at rest costs nothing, one that jumps is read at every answer. What is said of a loop is what
/// its last reading says, as one of knots that lie on a roller may be wrong: whoever asks holds it against the load
/// (MotionPatternTracker). Of any other rod a knot once lost stays lost, and so does one of which the rod ran through
/// itself.
///
/// What is read: of a fisherman's loop all that LoopTopology says; of any other rod the Alexander polynomial, the rod
/// closed far away beyond its ends, or by joining them where they lie on each other.
class KnotWatch {
 public:
  /// `standing_nodes`: of a fisherman's loop the lower knot's and the upper knot's, see LoopTopology; else empty.
  /// `closed`: the last node lies on the first. `radius`: h [m]. `windings`: of each tail of a fisherman's loop. The
  /// rod must not run through itself at the start: throws std::runtime_error.
  KnotWatch(const std::vector<int>& standing_nodes, bool closed, double radius, const Points& start, int windings = 1);

  /// The rod as it is now. What cannot be read, as the rod runs through itself, is a knot lost.
  KnotType follow(const Points& points);

  KnotType type() const { return type_; }
  int readings() const { return readings_; }

  /// All but the knot that it began as.
  void state(Archive& archive);

 private:
  LoopTopology::Reading read(const Points& points);

  std::optional<LoopTopology> loop_;
  bool closed_;
  double radius_;
  Points last_;  ///< the rod at the last reading
  int readings_ = 0;
  LoopTopology::Reading start_;
  KnotType type_ = KnotType::kKept;
};

}  // namespace knot_utm
