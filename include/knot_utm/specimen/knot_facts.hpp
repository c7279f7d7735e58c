#pragma once

#include <string>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/specimen/centreline.hpp"

namespace knot_utm {

/// What can be read from a knot's shape before anything pulls it.
struct KnotFacts {
  int strands = 0;              ///< ropes
  int crossings = 0;            ///< as seen from the front: x to the right, the load axis z up
  std::string type;             ///< which knot it is, in words and invariants
  double least_distance = 0.0;  ///< of two strands' centrelines; infinite where there are none [m]
  Vec3 nearest;                 ///< half-way between these two places [m]
  double sharpest_bend = 0.0;   ///< the least radius of the circle through the midpoints of two edges [m]
  Vec3 sharpest;                ///< the node between them [m]
};

/// `radius`: of the rod [m].
KnotFacts facts_of(const Centreline& knot, double radius);

}  // namespace knot_utm
