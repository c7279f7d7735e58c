#include "knot_utm/specimen/rest_shape.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

namespace {

constexpr double kLeastAcross = 0.01;  // of a direction, its part across the rod

/// alpha, once there are frames.
double angle_of_side(Axis towards, const RodState& state) {
  const Vec3 side = Vec3::Unit(static_cast<Eigen::Index>(towards));
  const Vec3 along = (state.position.col(1) - state.position.col(0)).normalized();
  const Vec3 first = state.reference_director.col(0);
  const double across_1 = side.dot(first), across_2 = side.dot(along.cross(first));
  if (std::hypot(across_1, across_2) < kLeastAcross)
    throw InvalidInput("specimen.natural_towards", kAxisNames[static_cast<std::size_t>(towards)],
                       "a direction across the first edge of the rod, which runs along it");
  return std::atan2(across_2, across_1);
}

}  // namespace

void give_rest_shape(const SpecimenOptions& specimen, RodProperties* rod, RodState* state) {
  const double curvature = specimen.natural_curvature, twist = 2.0 * M_PI * specimen.pre_twist;
  if (curvature == 0.0 && twist == 0.0) return;
  initialise_frames(state);
  const Eigen::Index inner = rod->nodes() - 2;
  const auto lbar = rod->voronoi_length.segment(1, inner);
  if (twist != 0.0) rod->natural_twist = -twist * lbar;
  if (curvature == 0.0) return;
  if (!state->curved_at_rest()) remember_bends(*rod, state);
  double angle = angle_of_side(specimen.natural_towards, *state);  // of the edge before the node
  for (Eigen::Index i = 0; i < inner; ++i) {
    const double turn = twist * lbar[i], middle = angle + 0.5 * turn;
    state->natural_curvature.col(i) = curvature * lbar[i] * Eigen::Vector2d(std::cos(middle), std::sin(middle));
    angle += turn;
  }
}

}  // namespace knot_utm
