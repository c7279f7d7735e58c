#include "knot_utm/rod/twisting.hpp"

#include <Eigen/Geometry>

namespace knot_utm {

namespace {

struct Corner {
  Corner(const Vec3& e, const Vec3& f)
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

StencilVector first_derivatives(const Corner& at) {
  return on_nodes(EdgePairGradient{at.binormal / (2.0 * at.length_e), at.binormal / (2.0 * at.length_f), -1.0, 1.0});
}

Mat3 cross_matrix(const Vec3& w) {
  Mat3 m;
  m << 0.0, -w.z(), w.y(), w.z(), 0.0, -w.x(), -w.y(), w.x(), 0.0;
  return m;
}

/// -(b (t + mean)^T + (t + mean) b^T)/(4 length^2)
Mat3 same_edge(const Corner& at, const Vec3& tangent, double length) {
  const Mat3 product = at.binormal * (tangent + at.mean).transpose();
  return -(product + product.transpose()) / (4.0 * length * length);
}

StencilMatrix second_derivatives(const Corner& at) {
  EdgePairHessian h;
  h.ee = same_edge(at, at.u, at.length_e);
  h.ff = same_edge(at, at.v, at.length_f);
  h.ef = (2.0 / at.chi * cross_matrix(at.u) - at.binormal * at.mean.transpose()) / (2.0 * at.length_e * at.length_f);
  return on_nodes(h);
}

TwistingResponse<double> respond(const TwistingInput& input, double twist) {
  const TwistedNode<double> node{input.k_t / input.voronoi_length, twist - input.natural_twist};
  return std::visit([&](const auto& law) { return law.respond(node); }, input.law);
}

}  // namespace

double twisting_energy(const TwistingInput& input, double twist) { return respond(input, twist).energy; }

StencilGradient twisting_gradient(const TwistingInput& input, const Vec3& e, const Vec3& f, double twist) {
  const TwistingResponse<double> law = respond(input, twist);
  StencilGradient local;
  local.energy = law.energy;
  local.gradient = law.moment * first_derivatives(Corner(e, f));
  return local;
}

Eigen::VectorXd twist_rates(const RodProperties& rod, const RodState& state) {
  if (state.twist.size() == 0) return {};
  const Eigen::Index inner = rod.nodes() - 2;
  const Eigen::VectorXd twist = state.twist.tail(inner) - state.twist.head(inner) + state.reference_twist;
  return twist.cwiseQuotient(rod.voronoi_length.segment(1, inner));
}

StencilLocal twisting(const TwistingInput& input, const Vec3& e, const Vec3& f, double twist) {
  const Corner at(e, f);
  const TwistingResponse<double> law = respond(input, twist);
  const StencilVector slope = first_derivatives(at);
  StencilLocal local;
  local.energy = law.energy;
  local.gradient = law.moment * slope;
  local.hessian = law.tangent * slope * slope.transpose() + law.moment * second_derivatives(at);
  return local;
}

}  // namespace knot_utm
