#pragma once

#include <vector>

#include "knot_utm/rod/rod.hpp"

namespace knot_utm {

/// Resamples a polyline into the whole number of equal chords nearest to `edge_length`; first and last point stay.
/// `position` (optional) gets the arclength on `points` of every node.
Points resample_evenly(const Points& points, double edge_length, std::vector<double>* position = nullptr);

/// Smallest distance between any two places of a polyline that lie at least `exclusion` apart along it [m]; infinity
/// where there are none. Closed: its last point lies on its first, and "along it" is the shorter way round.
double smallest_distance(const Points& points, double exclusion, bool closed = false);

}  // namespace knot_utm
