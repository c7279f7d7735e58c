#include "knot_utm/specimen/rest_shape.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

namespace {

constexpr double kLeastAcross = 0.01;  // of the axis x, its part across the rod

/// alpha, once there are frames.
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
