#pragma once

#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// The places at which a rod's contact is integrated, two for each inner node and in their order along the rod: the
/// smooth centreline by which strands touch (centreline_curve.hpp). Of nodes on a circle, with edges l, they lie within
/// l^4/R^3 of the circle of radius R whose circumference is as long as all edges. Without columns where there are fewer
/// than three nodes.
Points sampled_centreline(const Points& nodes);

}  // namespace knot_utm
