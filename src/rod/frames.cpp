#include "knot_utm/rod/frames.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "knot_utm/rod/rod.hpp"

namespace knot_utm {

Vec3 any_normal(const Vec3& t) {
  Eigen::Index smallest = 0;
  t.cwiseAbs().minCoeff(&smallest);
  return t.cross(Vec3::Unit(smallest)).normalized();
}

Vec3 parallel_transport(const Vec3& w, const Vec3& from, const Vec3& to) {
  const Vec3 sum = from + to;
  const double half_squared = 0.5 * sum.squaredNorm();  // 1 + from . to
  constexpr double kOpposite = 1e-14;
  if (half_squared < kOpposite) {
    const Vec3 normal = any_normal(from);
    return 2.0 * normal.dot(w) * normal - w;
  }
  // Two reflections: the first takes `from` to -`to`, the second turns that into `to`.
  return w - (sum.dot(w) / half_squared) * sum + (2.0 * from.dot(w)) * to;
}

Points tangents(const Points& position) {
  const Eigen::Index edges = position.cols() - 1;
  Points t = position.rightCols(edges) - position.leftCols(edges);
  t.colwise().normalize();
  return t;
}

namespace {

/// The unit vector along the part of d normal to t.
Vec3 normal_part(const Vec3& d, const Vec3& t) { return (d - d.dot(t) * t).normalized(); }

Vec3 column(const Points& points, Eigen::Index j) { return points.col(j); }

}  // namespace

Vec3 transported_director(const Vec3& d1, const Vec3& from, const Vec3& to) {
  return normal_part(parallel_transport(d1, from, to), to);
}

double nearest_turn(double angle, double last) { return last + std::remainder(angle - last, 2.0 * M_PI); }

Points space_parallel_directors(const Points& position, const Vec3& first) {
  const Points t = tangents(position);
  Points d1(3, t.cols());
  d1.col(0) = normal_part(first, t.col(0));
  for (Eigen::Index j = 1; j < t.cols(); ++j) d1.col(j) = transported_director(d1.col(j - 1), t.col(j - 1), t.col(j));
  return d1;
}

double signed_angle(const Vec3& a, const Vec3& b, const Vec3& axis) {
  return std::atan2(a.cross(b).dot(axis), a.dot(b));
}

double reference_twist(const Vec3& d1_e, const Vec3& t_e, const Vec3& d1_f, const Vec3& t_f) {
  return signed_angle(parallel_transport(d1_e, t_e, t_f), d1_f, t_f);
}

Directors material_directors(const Vec3& t, const Vec3& d1, double theta) {
  const Vec3 d2 = t.cross(d1);
  const double cosine = std::cos(theta);
  const double sine = std::sin(theta);
  return {cosine * d1 + sine * d2, cosine * d2 - sine * d1};
}

void initialise_frames(RodState* state) {
  const Eigen::Index edges = state->position.cols() - 1;
  const Vec3 first_tangent = (state->position.col(1) - state->position.col(0)).normalized();
  state->reference_director = space_parallel_directors(state->position, any_normal(first_tangent));
  state->reference_twist = Eigen::VectorXd::Zero(edges - 1);
  state->twist = Eigen::VectorXd::Zero(edges);
  state->twist_rate = Eigen::VectorXd::Zero(edges);
}

void transport_frames(const Points& position_before, RodState* state) {
  const Points before = tangents(position_before);
  const Points now = tangents(state->position);
  Points& d1 = state->reference_director;
  for (Eigen::Index j = 0; j < now.cols(); ++j) d1.col(j) = transported_director(d1.col(j), before.col(j), now.col(j));
  for (Eigen::Index i = 0; i + 1 < now.cols(); ++i) {
    const double angle = reference_twist(column(d1, i), column(now, i), column(d1, i + 1), column(now, i + 1));
    // The angle is known up to whole turns; the one next to the last value is the one that moved there.
    state->reference_twist[i] = nearest_turn(angle, state->reference_twist[i]);
  }
}

}  // namespace knot_utm
