#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// Arclength of every point along the polyline [m]. `cuts`: its edges that are no part of it and have no length.
std::vector<double> arclengths(const Points& points, const std::vector<int>& cuts = {});

/// Resamples a polyline into equal chords whose length is nearest to `edge_length`; first and last point stay.
/// `position` (optional) gets the arclength on `points` of every node.
Points resample_evenly(const Points& points, double edge_length, std::vector<double>* position = nullptr);

/// Target lengths of edges along a line: at most `coarse`, and shorter in and near zones.
struct EdgeGrading {
  struct Zone {
    double begin, end;   ///< arclength [m]
    double edge_length;  ///< within [m]
  };
  double coarse = 0.0;  ///< far from every zone [m]
  std::vector<Zone> zones;

  /// Target length of an edge at arclength s [m]. It grows by a quarter of the distance from a zone.
  double operator()(double s) const;
};

/// Resamples a polyline to edges of the target lengths, all scaled by the one factor that makes their number whole;
/// first and last point stay. `position` (optional) gets the arclength on `points` of every node.
Points resample_graded(const Points& points, const EdgeGrading& wanted, std::vector<double>* position = nullptr);

/// Where a polyline comes near itself: from the first to the last of its nodes that are nearer than `near` [m] to one
/// which lies `apart` [m] away along it, or further. Arclengths [m]; empty: nowhere.
std::optional<std::pair<double, double>> part_near_itself(const Points& points, double near, double apart);

/// Two places of a polyline, and how far apart they are [m].
struct NearestPlaces {
  double distance = 0.0;
  double thinner = 0.0;              ///< by which both radii together are less than those of the thickest rope [m]
  double first = 0.0, second = 0.0;  ///< arclengths [m]
  Vec3 middle = Vec3::Zero();        ///< half-way between them [m]
};

/// The two places of a polyline that are nearest to each other among those at least `exclusion` [m] apart along it;
/// their distance is infinite where there are none. What lies on different sides of one of its `cuts` is always far
/// enough apart. `radii`: of the ropes between the cuts [m]; none: all are alike. What counts then is the distance of
/// their surfaces, and the exclusion, that of the thickest one, is in proportion to the radius.
NearestPlaces nearest_places(const Points& points, double exclusion, const std::vector<int>& cuts = {},
                             const std::vector<double>& radii = {});

}  // namespace knot_utm
