#pragma once

#include <Eigen/Core>
#include <vector>

#include "knot_utm/record/per_knot.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/specimen/centreline.hpp"

namespace knot_utm {

/// What a knot's file reads of the knot. Its lengths are those of the rod at rest.
///
/// Two places of the rod touch where the polylines through its nodes are nearer to each other than 1.05 times both
/// radii together, and more than 3 pi/2 radii of rod lie between them. Strands that press on each other are nearer by a
/// clear margin, so that a touch does not come and go with the force of a contact, and the place at which strands begin
/// to touch moves along the rod as smoothly as the strands do. Posts do not count.
class KnotReadings {
 public:
  KnotReadings(const Centreline& centreline, const RodProperties& rod);

  /// In the order of the file [m]; unknown where the rope touches nothing before its end.
  PerKnot at(const Points& position) const;

 private:
  /// Edges in the order of their height, of which those near a place are neighbours.
  struct Shape {
    const Points& position;
    Points middle;                // of the edges [m]
    Eigen::VectorXd half_length;  // of the edges [m]
    std::vector<int> by_height;   // edges that are not cut
    double longest = 0.0;         // of the half lengths [m]
  };
  Shape shape_of(const Points& position) const;
  /// Arclength at rest of the first touch on the way from a node, up (1) or down (-1) the rod; unknown: there is none.
  double first_touch(int node, int step, const Shape& shape) const;

  std::vector<KnotReading> read_;
  Eigen::VectorXd arclength_;  // of the nodes [m]
  Eigen::VectorXd radius_;     // of the edges [m]; 0: it is cut
};

}  // namespace knot_utm
