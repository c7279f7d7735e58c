#include "knot_utm/specimen/centreline.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "knot_utm/contact/centreline_curve.hpp"
#include "knot_utm/contact/tunnelling.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/specimen/options.hpp"
#include "knot_utm/specimen/polyline.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"
#include "path.hpp"

namespace knot_utm {

namespace {

constexpr double kMostEdges = 2e4;  // of a shape from a file: each is compared with each other one

// Places nearer than the first and further apart along the rod than the second of these make a shape near itself. By
// choice: further than strands that touch (2), and no bend that a rod takes by itself.
constexpr double kNearItself = 8.0, kAwayAlong = 20.0;  // [h]

/// Nodes along a polyline, with finer edges where it comes near itself.
Points graded(const Points& polyline, double radius, double edge_length, double refinement) {
  if (refinement == 1.0) return resample_evenly(polyline, edge_length);
  const Points even = resample_evenly(polyline, edge_length);
  const auto tangled = part_near_itself(even, kNearItself * radius, kAwayAlong * radius);
  if (!tangled) return resample_evenly(polyline, edge_length / refinement);
  const double longer = arclengths(polyline).back() / arclengths(even).back();
  return resample_graded(
      polyline, {edge_length, {{tangled->first * longer, tangled->second * longer, edge_length / refinement}}});
}

}  // namespace

double Centreline::length() const { return arclengths(points).back(); }

int Centreline::nearest_node(double arclength) const {
  const std::vector<double> at = arclengths(points);
  const auto next = std::lower_bound(at.begin() + 1, at.end() - 1, arclength);
  const int node = static_cast<int>(next - at.begin());
  return arclength - *(next - 1) < *next - arclength ? node - 1 : node;
}

void check_no_overlap(const Centreline& centreline, double radius, const char* key, const std::string& value,
                      const std::vector<double>& radii, const Vec3* origin) {
  const Points& points = centreline.points;
  const auto refuse = [&](const std::string& why) {
    throw InvalidInput::sentence(key, std::string(key) + " " + shown(value) + ": " + why);
  };
  const auto length = [&](double metres) { return origin ? text(metres / radius) + " radii" : text(metres) + " m"; };
  // A polyline cuts the corners of the smooth centreline along which strands touch, so strands that touch seem to
  // overlap. Strands of a tight knot that another run left behind do overlap a little.
  constexpr double kMayOverlap = 0.07;  // by choice: of a shape from a file or of a loop [h]
  constexpr double kCutCorners = 0.02;  // by choice: of sketched ropes, even with coarse edges [h]
  const double exclusion = 1.5 * M_PI * radius;
  const NearestPlaces nearest = nearest_places(points, exclusion, centreline.cuts, radii);
  const double touching = 2.0 * radius - nearest.radius_deficit;
  const bool of_ropes = !centreline.cuts.empty();
  if (nearest.distance < touching - (centreline.cuts.empty() ? 0.0 : kCutCorners * radius) &&
      (of_ropes || nearest_places(sampled_centreline(points), exclusion).distance < (2.0 - kMayOverlap) * radius))
    refuse("strands overlap at " +
           (origin ? place_text((nearest.middle - *origin) / radius)
                   : text(nearest.first) + " m and " + text(nearest.second) + " m along the rod") +
           ", where they are " + length(nearest.distance) + " apart, but must be at least " +
           (nearest.radius_deficit > 0.0 ? "both radii" : "a diameter") + " apart, " + length(touching));
  TunnellingSearch search(points.cols());
  for (const int cut : centreline.cuts) search.part(cut);
  if (const std::optional<Tunnelling> passage = search.find(points, points)) {
    const std::vector<double> at = arclengths(points, centreline.cuts);
    auto place = [&](int edge, double fraction) {
      const auto i = static_cast<std::size_t>(edge);
      return text(at[i] + fraction * (at[i + 1] - at[i]));
    };
    const Vec3 there =
        points.col(passage->edge_a) + passage->on_a * (points.col(passage->edge_a + 1) - points.col(passage->edge_a));
    refuse("the rod runs through itself at " + (origin ? place_text((there - *origin) / radius)
                                                       : place(passage->edge_a, passage->on_a) + " m and " +
                                                             place(passage->edge_b, passage->on_b) + " m along it"));
  }
}

Centreline straight(double length, double radius, double edge_length) {
  check_radius(radius);
  check_edge_length(edge_length, radius);
  if (!(length >= 4.0 * edge_length && length <= 100.0))
    throw InvalidInput("specimen.length", text(length),
                       limits_text(4.0 * edge_length, 100.0) + " m: at least four edges");
  const auto edges = static_cast<Eigen::Index>(std::round(length / edge_length));
  Centreline centreline;
  centreline.points = Points::Zero(3, edges + 1);
  centreline.points.row(2).setLinSpaced(0.0, length);
  return centreline;
}

Centreline from_points(const Points& points, double radius, double edge_length, const std::string& name,
                       double refinement) {
  check_radius(radius);
  check_edge_length(edge_length, radius);
  const auto refuse = [&](const std::string& why) {
    throw InvalidInput::sentence("specimen.file", "specimen.file " + shown(name) + why);
  };
  if (!points.allFinite()) refuse(" has a point that is not finite");
  if (points.cols() < 2) refuse(" has " + std::to_string(points.cols()) + " points, but must have two or more");
  for (Eigen::Index i = 1; i < points.cols(); ++i)
    if (points.col(i) == points.col(i - 1))
      refuse(": points " + std::to_string(i) + " and " + std::to_string(i + 1) +
             " are the same; leave one of them out");
  const double length =
      (points.rightCols(points.cols() - 1) - points.leftCols(points.cols() - 1)).colwise().norm().sum();
  const std::string rod = " is a rod of " + text(length) + " m, but must be at ";
  if (!(length >= 4.0 * edge_length)) refuse(rod + "least four edges long, " + text(4.0 * edge_length) + " m");
  const double most = kMostEdges * edge_length / refinement;
  if (!(length <= most)) refuse(rod + "most " + text(kMostEdges) + " edges long, " + text(most) + " m");
  Centreline centreline;
  centreline.points = graded(points, radius, edge_length, refinement);
  check_no_overlap(centreline, radius, "specimen.file", name);
  return centreline;
}

namespace {

constexpr double kLeastAcross = 0.01;  // the x axis gives the side if its part normal to the rod is larger [-]

/// alpha of give_rest_shape; the state has its frames.
double angle_of_side(const RodState& state) {
  const Vec3 along = (state.position.col(1) - state.position.col(0)).normalized();
  const Vec3 first = state.reference_director.col(0);
  const Vec3 side = std::hypot(along.y(), along.z()) < kLeastAcross ? Vec3::UnitY() : Vec3::UnitX();
  return std::atan2(side.dot(along.cross(first)), side.dot(first));
}

}  // namespace

void give_rest_shape(const SpecimenOptions& specimen, const RodProperties& rod, RodState* state) {
  const double curvature = specimen.natural_curvature;
  if (curvature == 0.0) return;
  initialise_frames(state);
  const Eigen::Index inner = rod.nodes() - 2;
  if (!state->curved_at_rest()) remember_bends(rod, state);
  const double angle = angle_of_side(*state);
  for (Eigen::Index i = 0; i < inner; ++i)
    state->natural_curvature.col(i) =
        curvature * rod.voronoi_length[i + 1] * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

}  // namespace knot_utm
