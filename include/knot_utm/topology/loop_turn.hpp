#pragma once

#include <optional>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/frames.hpp"

namespace knot_utm {

/// How far a loop has moved around its rollers, from shape to shape.
///
/// The rod runs from one knot over the upper roller, down the far side and around the lower roller to the other knot.
/// Half-way between its highest and its lowest node, its outer fifths aside, lies the middle of the far side. Pulling
/// the rollers apart leaves that point of the rod where it is, and so does stretching; a loop that turns carries
/// another one there.
class LoopTurn {
 public:
  /// Adds a shape, its nodes in the order of the rod. The first shape counts as not turned.
  void add(const Points& shape);

  /// Largest motion around the rollers since the first shape [m], within the length of an edge.
  double largest() const { return largest_; }

 private:
  std::optional<double> first_;  ///< arclength of the middle of the far side, from the middle of the rod [m]
  double largest_ = 0.0;
};

}  // namespace knot_utm
