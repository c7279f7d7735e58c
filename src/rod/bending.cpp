#include "knot_utm/rod/bending.hpp"

namespace knot_utm {

namespace {

/// The two edges of an inner node, as every term below needs them.
struct Corner {
  Corner(const Vec3& e, const Vec3& f)
      : length_e(e.norm()), length_f(f.norm()), u(e / length_e), v(f / length_f), c(u.dot(v)), chi(1.0 + c) {}
  double length_e, length_f;
  Vec3 u, v;
  double c, chi;
};

/// One curvature from the k-th directors p on e and q on f, and the same directors' derivatives in theta.
struct Curvature {
  const Corner& at;
  Vec3 p, q, dp, dq;

  double value() const { return (at.v.dot(p) - at.u.dot(q)) / at.chi; }
  double in_theta_e() const { return at.v.dot(dp) / at.chi; }
  double in_theta_f() const { return -at.u.dot(dq) / at.chi; }
  Vec3 in_u(double kappa) const { return -(at.c * p + q + kappa * at.v) / at.chi; }
  Vec3 in_v(double kappa) const { return (p + at.c * q - kappa * at.u) / at.chi; }
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
  const double kappa = k.value();
  return {across(k.in_u(kappa), k.at.u) / k.at.length_e, across(k.in_v(kappa), k.at.v) / k.at.length_f, k.in_theta_e(),
          k.in_theta_f()};
}

EdgePairHessian second_derivatives(const Curvature& k) {
  const Corner& at = k.at;
  const Vec3 &u = at.u, &v = at.v, &p = k.p, &q = k.q;
  const double kappa = k.value();
  const Vec3 k_u = k.in_u(kappa);
  const Vec3 k_v = k.in_v(kappa);
  const double k_te = k.in_theta_e();
  const double k_tf = k.in_theta_f();

  const Mat3 pv = p * v.transpose();
  const Mat3 qu = q * u.transpose();
  const Mat3 k_u_v = k_u * v.transpose();
  const Mat3 k_v_u = k_v * u.transpose();
  const Mat3 k_uu = (-0.5 * (pv + pv.transpose()) - k_u_v - k_u_v.transpose()) / at.chi;
  const Mat3 k_vv = (0.5 * (qu + qu.transpose()) - k_v_u - k_v_u.transpose()) / at.chi;
  const Mat3 k_uv =
      (v * q.transpose() - p * u.transpose() - k_u * u.transpose() - v * k_v.transpose() - kappa * Mat3::Identity()) /
      at.chi;

  const double length_e2 = at.length_e * at.length_e;
  const double length_f2 = at.length_f * at.length_f;
  EdgePairHessian h;
  h.ee = (across(k_uu, u, u) + sphere_term(k_u, u)) / length_e2;
  h.ff = (across(k_vv, v, v) + sphere_term(k_v, v)) / length_f2;
  h.ef = across(k_uv, u, v) / (at.length_e * at.length_f);
  h.e_theta_e = across(-(at.c * k.dp + k_te * v) / at.chi, u) / at.length_e;
  h.e_theta_f = across(-(k.dq + k_tf * v) / at.chi, u) / at.length_e;
  h.f_theta_e = across((k.dp - k_te * u) / at.chi, v) / at.length_f;
  h.f_theta_f = across((at.c * k.dq - k_tf * u) / at.chi, v) / at.length_f;
  h.theta_e_theta_e = -v.dot(p) / at.chi;
  h.theta_f_theta_f = u.dot(q) / at.chi;
  return h;
}

}  // namespace

Eigen::Vector2d material_curvature(const Vec3& e, const Vec3& f, const Directors& on_e, const Directors& on_f) {
  const Corner at(e, f);
  return {first_curvature(at, on_e, on_f).value(), second_curvature(at, on_e, on_f).value()};
}

double bending_energy(const BendingInput& input, const Vec3& e, const Vec3& f, const Directors& on_e,
                      const Directors& on_f) {
  return 0.5 * input.k_b / input.voronoi_length *
         (material_curvature(e, f, on_e, on_f) - input.natural_curvature).squaredNorm();
}

StencilGradient bending_gradient(const BendingInput& input, const Vec3& e, const Vec3& f, const Directors& on_e,
                                 const Directors& on_f) {
  const Corner at(e, f);
  const double stiffness = input.k_b / input.voronoi_length;
  StencilGradient local;
  const auto add = [&](const Curvature& k, double natural) {
    const double off = k.value() - natural;
    local.energy += 0.5 * stiffness * off * off;
    local.gradient += (stiffness * off) * on_nodes(first_derivatives(k));
  };
  add(first_curvature(at, on_e, on_f), input.natural_curvature[0]);
  add(second_curvature(at, on_e, on_f), input.natural_curvature[1]);
  return local;
}

StencilLocal bending(const BendingInput& input, const Vec3& e, const Vec3& f, const Directors& on_e,
                     const Directors& on_f) {
  const Corner at(e, f);
  const double stiffness = input.k_b / input.voronoi_length;
  StencilLocal local;
  const auto add = [&](const Curvature& k, double natural) {
    const double off = k.value() - natural;
    const StencilVector slope = on_nodes(first_derivatives(k));
    local.energy += 0.5 * stiffness * off * off;
    local.gradient += (stiffness * off) * slope;
    local.hessian += stiffness * slope * slope.transpose() + (stiffness * off) * on_nodes(second_derivatives(k));
  };
  add(first_curvature(at, on_e, on_f), input.natural_curvature[0]);
  add(second_curvature(at, on_e, on_f), input.natural_curvature[1]);
  return local;
}

}  // namespace knot_utm
