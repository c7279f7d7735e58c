#pragma once

#include <optional>
#include <vector>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/record/ended_by.hpp"
#include "knot_utm/topology/knot_invariants.hpp"

namespace knot_utm {

/// Follows whether a specimen is still the knot that it began as (doc/model.md, section 12): by LoopTopology for a
/// fisherman's loop, and for any other rod by the Alexander polynomial of the rod closed far beyond its ends.
///
/// Before strands can pass each other, or an end slips out of a coil, some node has to move by about the rod's radius h
/// (or what contacts leave of soft sections, RodMaterial::core_radius). So the topology is read again only once a node
/// has moved by h since the last reading. The type of a loop is that of its last reading: a reading near a roller may
/// be wrong, and is judged together with the load (MotionPatternTracker). Any other rod that has once lost its knot, or
/// run through itself, keeps that type; one that began without a knot cannot lose it.
class KnotWatch {
 public:
  /// `standing_nodes`: those of the lower and the upper knot of a fisherman's loop (LoopTopology); else empty.
  /// `radius`: h [m]. `windings`: of each tail of a fisherman's loop. Throws std::runtime_error if the rod runs through
  /// itself at the start.
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
