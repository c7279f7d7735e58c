#pragma once

#include <optional>
#include <vector>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/topology/knot_invariants.hpp"

namespace knot_utm {

/// Follows whether a specimen is still the knot that it began as.
///
/// No strand can pass another one, and no end can slip out of a coil, before some node has moved by about the rod's
/// radius h, or by what contacts leave of soft sections (RodMaterial::core_radius). So the topology is read again only
/// once a node has moved by h since the last reading: a test at rest costs nothing, and one that jumps is read at every
/// answer. The type of a loop is that of its last reading. Near a roller a reading may be wrong, and so it is judged
/// together with the load (MotionPatternTracker). Any other rod that has lost its knot once, or has run through itself,
/// keeps that result.
///
/// A rod that began without a knot keeps its type: there is none that could be lost.
///
/// For a fisherman's loop the reading is that of LoopTopology. For any other rod it is the Alexander polynomial of the
/// rod closed far beyond its ends.
class KnotWatch {
 public:
  /// `standing_nodes`: those of the lower and the upper knot of a fisherman's loop (LoopTopology); else empty.
  /// `radius`: h [m]. `windings`: of each tail of a fisherman's loop. The
  /// rod must not run through itself at the start: throws std::runtime_error.
  KnotWatch(const std::vector<int>& standing_nodes, double radius, const Points& start, int windings = 1);

  /// Follows the rod to its present shape. A rod that runs through itself cannot be read; its knot counts as lost.
  KnotType follow(const Points& points);

  KnotType type() const { return type_; }
  int readings() const { return readings_; }

  /// Saves or loads everything except the knot that it began as.
  void state(Archive& archive);

 private:
  LoopTopology::Reading read(const Points& points);

  std::optional<LoopTopology> loop_;
  double radius_;
  Points last_;  ///< the rod at the last reading
  int readings_ = 0;
  LoopTopology::Reading start_;
  KnotType type_ = KnotType::kKept;
};

}  // namespace knot_utm
