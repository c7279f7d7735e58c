#pragma once

#include <optional>

#include "knot_utm/numeric/points.hpp"

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

/// The largest circle within a planar curve with two ends, which touches the curve and does not cross it. The curve
/// encloses the circle: from its centre there is no way out to far away that does not cross the curve.
struct EnclosedCircle {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 0.0;  ///< 0: the curve encloses nothing
};

/// The largest circle that an open curve encloses, as seen along the third row of `rotation`. The curve goes straight
/// from each of `points` to the next. The radius is too small by at most `tolerance`, which is more than 0, and never
/// too large. Only circles with a radius above `larger_than` are looked for.
EnclosedCircle largest_enclosed_circle(const Points& points, const Mat3& rotation, double tolerance,
                                       double larger_than = 0.0);

/// Diameter of the thickest round pin that goes straight through a rod's knot without touching the rod [m]: twice
/// r - h, r the radius of the largest circle that the centreline encloses in any view, h the rod's `radius`. The pin is
/// longer than the rod, so that all of it must be out of the way. 0 where no pin goes through; a straight rod has no
/// hole.
///
/// `points`: places on the centreline, as near to each other as to show its bends: a chord of length c at a bend of
/// radius R lies up to c^2/(8 R) inside it. The views are 400, evenly over all directions, of which the best eight are
/// then turned further while that widens the hole by more than a thousandth of h. A hole that is seen from fewer than
/// one of the 400 is missed, so that the diameter may be too small and is never too large.
double hole_diameter(const Points& points, double radius);

}  // namespace knot_utm
