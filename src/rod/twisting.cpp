#include "knot_utm/rod/twisting.hpp"

#include <Eigen/Geometry>

#include "knot_utm/rod/rod.hpp"

namespace knot_utm {
namespace {

struct TwistCorner {
  TwistCorner(const Vec3& e, const Vec3& f)
      : length_e(e.norm()),
        length_f(f.norm()),
        u(e / length_e),
        v(f / length_f),
        chi(1.0 + u.dot(v)),
        binormal(2.0 / chi * u.cross(v)),
        mean((u + v) / chi) {}
  double length_e, length_f;
  Vec3 u, v;
  double chi;
  Vec3 binormal;
  Vec3 mean;
};

StencilVector twist_slopes(const TwistCorner& at) {
  return on_nodes(EdgePairGradient{at.binormal / (2.0 * at.length_e), at.binormal / (2.0 * at.length_f), -1.0, 1.0});
}

Mat3 cross_matrix(const Vec3& w) {
  Mat3 m;
  m << 0.0, -w.z(), w.y(), w.z(), 0.0, -w.x(), -w.y(), w.x(), 0.0;
  return m;
}

/// -(b (t + mean)^T + (t + mean) b^T)/(4 length^2)
Mat3 same_edge(const TwistCorner& at, const Vec3& tangent, double length) {
  const Mat3 product = at.binormal * (tangent + at.mean).transpose();
  return -(product + product.transpose()) / (4.0 * length * length);
}

StencilMatrix twist_curvatures(const TwistCorner& at) {
  EdgePairHessian h;
  h.ee = same_edge(at, at.u, at.length_e);
  h.ff = same_edge(at, at.v, at.length_f);
  h.ef = (2.0 / at.chi * cross_matrix(at.u) - at.binormal * at.mean.transpose()) / (2.0 * at.length_e * at.length_f);
  return on_nodes(h);
}

/// k_t/lbar [N m]
double stiffness(const TwistingInput& input) { return input.k_t / input.voronoi_length; }

/// dE/dm [N m]
double moment(const TwistingInput& input, double twist) { return stiffness(input) * twist; }

}  // namespace

double twisting_energy(const TwistingInput& input, double twist) {
  const double m = moment(input, twist);
  return 0.5 * m * m / stiffness(input);
}

Eigen::VectorXd twist_rates(const RodProperties& rod, const RodState& state) {
  if (state.twist.size() == 0) return {};
  const Eigen::Index inner = rod.nodes() - 2;
  const Eigen::VectorXd twist = state.twist.tail(inner) - state.twist.head(inner) + state.reference_twist;
  return twist.cwiseQuotient(rod.voronoi_length.segment(1, inner));
}

StencilLocal twisting(const TwistingInput& input, const Vec3& e, const Vec3& f, double twist) {
  const TwistCorner at(e, f);
  const StencilVector slope = twist_slopes(at);
  StencilLocal local;
  local.energy = twisting_energy(input, twist);
  local.gradient = moment(input, twist) * slope;
  local.hessian = stiffness(input) * slope * slope.transpose() + moment(input, twist) * twist_curvatures(at);
  return local;
}

}  // namespace knot_utm
