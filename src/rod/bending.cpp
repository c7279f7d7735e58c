#include "knot_utm/rod/bending.hpp"

#include <cmath>

#include "knot_utm/rod/elastic_bending.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/rod/turning_angle.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {
namespace {

/// The two edges of an inner node, as every term below needs them.
struct Corner {
  Corner(const Vec3& e, const Vec3& f)
      : length_e(e.norm()), length_f(f.norm()), u(e / length_e), v(f / length_f), c(u.dot(v)) {
    const double w = 0.25 * (v - u).squaredNorm(), pole = 1.0 / (1.0 - w);
    const SquaredAngleOverW<double> over = squared_angle_over(w);
    // 16 s^2 = G/(1 - w), and its derivatives in w; dw/dc = -1/2.
    const double square = over.value * pole, square_w = (over.first + square) * pole;
    const double square_ww = (over.second + 2.0 * square_w) * pole;
    s = 0.25 * std::sqrt(square);
    const double s_w = square_w / (32.0 * s), s_ww = (square_ww / 32.0 - s_w * s_w) / s;
    s_c = -0.5 * s_w;
    s_cc = 0.25 * s_ww;
  }
  double length_e, length_f;
  Vec3 u, v;
  double c, s, s_c, s_cc;
};

/// One curvature from the k-th directors p on e and q on f, and the same directors' derivatives in theta.
struct Curvature {
  const Corner& at;
  Vec3 p, q, dp, dq;

  double projection() const { return at.v.dot(p) - at.u.dot(q); }
  Vec3 projection_in_u() const { return -(at.c * p + q); }
  Vec3 projection_in_v() const { return p + at.c * q; }

  double value() const { return at.s * projection(); }
  double in_theta_e() const { return at.s * at.v.dot(dp); }
  double in_theta_f() const { return -at.s * at.u.dot(dq); }
  Vec3 in_u() const { return at.s * projection_in_u() + (at.s_c * projection()) * at.v; }
  Vec3 in_v() const { return at.s * projection_in_v() + (at.s_c * projection()) * at.u; }
};

Curvature first_curvature(const Corner& at, const Directors& on_e, const Directors& on_f) {
  return {at, on_e.m1, on_f.m1, on_e.m2, on_f.m2};
}

Curvature second_curvature(const Corner& at, const Directors& on_e, const Directors& on_f) {
  return {at, on_e.m2, on_f.m2, -on_e.m1, -on_f.m1};
}

Vec3 across(const Vec3& w, const Vec3& t) { return w - w.dot(t) * t; }

Mat3 across(const Mat3& h, const Vec3& left, const Vec3& right) {
  return (Mat3::Identity() - left * left.transpose()) * h * (Mat3::Identity() - right * right.transpose());
}

/// What g . u adds to the Hessian because u = e/|e| moves on a sphere; times |e|^2.
Mat3 sphere_term(const Vec3& g, const Vec3& u) {
  const Vec3 flat = across(g, u);
  return -flat * u.transpose() - u * flat.transpose() - g.dot(u) * (Mat3::Identity() - u * u.transpose());
}

EdgePairGradient first_derivatives(const Curvature& k) {
  return {across(k.in_u(), k.at.u) / k.at.length_e, across(k.in_v(), k.at.v) / k.at.length_f, k.in_theta_e(),
          k.in_theta_f()};
}

EdgePairHessian second_derivatives(const Curvature& k) {
  const Corner& at = k.at;
  const Vec3 &u = at.u, &v = at.v, &p = k.p, &q = k.q;
  const double n = k.projection();
  const Mat3 pv = p * v.transpose();
  const Mat3 qu = q * u.transpose();
  const Mat3 n_u_v = k.projection_in_u() * v.transpose();
  const Mat3 n_v_u = k.projection_in_v() * u.transpose();
  const Mat3 k_uu =
      -0.5 * at.s * (pv + pv.transpose()) + at.s_c * (n_u_v + n_u_v.transpose()) + (at.s_cc * n) * v * v.transpose();
  const Mat3 k_vv =
      0.5 * at.s * (qu + qu.transpose()) + at.s_c * (n_v_u + n_v_u.transpose()) + (at.s_cc * n) * u * u.transpose();
  const Mat3 k_uv =
      at.s * (v * q.transpose() - p * u.transpose()) + (at.s_cc * n) * v * u.transpose() +
      at.s_c * (k.projection_in_u() * u.transpose() + v * k.projection_in_v().transpose() + n * Mat3::Identity());

  const double length_e2 = at.length_e * at.length_e;
  const double length_f2 = at.length_f * at.length_f;
  const double turned_e = at.s_c * v.dot(k.dp), turned_f = at.s_c * u.dot(k.dq);
  EdgePairHessian h;
  h.ee = (across(k_uu, u, u) + sphere_term(k.in_u(), u)) / length_e2;
  h.ff = (across(k_vv, v, v) + sphere_term(k.in_v(), v)) / length_f2;
  h.ef = across(k_uv, u, v) / (at.length_e * at.length_f);
  h.e_theta_e = across(turned_e * v - (at.s * at.c) * k.dp, u) / at.length_e;
  h.e_theta_f = across(-turned_f * v - at.s * k.dq, u) / at.length_e;
  h.f_theta_e = across(turned_e * u + at.s * k.dp, v) / at.length_f;
  h.f_theta_f = across(-turned_f * u + (at.s * at.c) * k.dq, v) / at.length_f;
  h.theta_e_theta_e = -at.s * v.dot(p);
  h.theta_f_theta_f = at.s * u.dot(q);
  return h;
}

BendingResponse elastic(const BendingInput& input, const Eigen::Vector2d& bend) {
  return ElasticBending{}.respond({input.k_b, input.voronoi_length, bend, input.natural_curvature});
}

}  // namespace

Eigen::Vector2d material_curvature(const Vec3& e, const Vec3& f, const Directors& on_e, const Directors& on_f) {
  const Corner at(e, f);
  return {first_curvature(at, on_e, on_f).value(), second_curvature(at, on_e, on_f).value()};
}

CurvatureLocal curvature_local(const Vec3& e, const Vec3& f, const Directors& on_e, const Directors& on_f) {
  const Corner at(e, f);
  const Curvature first = first_curvature(at, on_e, on_f), second = second_curvature(at, on_e, on_f);
  CurvatureLocal out;
  out.value << first.value(), second.value();
  out.slope[0] = on_nodes(first_derivatives(first));
  out.slope[1] = on_nodes(first_derivatives(second));
  out.second[0] = on_nodes(second_derivatives(first));
  out.second[1] = on_nodes(second_derivatives(second));
  return out;
}

StencilLocal on_nodes(const BendingResponse& law, const CurvatureLocal& bend) {
  StencilLocal out;
  out.energy = law.energy;
  for (int k = 0; k < 2; ++k) {
    out.gradient += law.moment[k] * bend.slope[k];
    out.hessian += law.tangent(k, k) * bend.slope[k] * bend.slope[k].transpose() + law.moment[k] * bend.second[k];
  }
  if (law.tangent(0, 1) != 0.0) {
    const StencilMatrix coupled = law.tangent(0, 1) * bend.slope[0] * bend.slope[1].transpose();
    out.hessian += coupled + coupled.transpose();
  }
  return out;
}

double bending_energy(const BendingInput& input, const Vec3& e, const Vec3& f, const Directors& on_e,
                      const Directors& on_f) {
  return elastic(input, material_curvature(e, f, on_e, on_f)).energy;
}

StencilLocal bending(const BendingInput& input, const Vec3& e, const Vec3& f, const Directors& on_e,
                     const Directors& on_f) {
  const CurvatureLocal bend = curvature_local(e, f, on_e, on_f);
  return on_nodes(elastic(input, bend.value), bend);
}

}  // namespace knot_utm
