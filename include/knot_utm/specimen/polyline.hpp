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

/// Two places of a polyline.
struct NearestPlaces {
  double distance = 0.0;             ///< infinite where there are none [m]
  double radius_deficit = 0.0;       ///< twice the radius of the thickest rope, less the radii of both [m]
  double first = 0.0, second = 0.0;  ///< arclengths [m]
  Vec3 middle = Vec3::Zero();        ///< half-way between them [m]
};

/// The two places of a polyline with the least distance among those at least `exclusion` [m] apart along it. Places on
/// different sides of one of its `cuts` always count. `radii`: of the ropes between the cuts [m]; none: all are alike.
/// Where they differ, the places whose surfaces have the least distance are found, and a rope's exclusion is
/// `exclusion` times its radius over the largest one.
NearestPlaces nearest_places(const Points& points, double exclusion, const std::vector<int>& cuts = {},
                             const std::vector<double>& radii = {});

}  // namespace knot_utm
