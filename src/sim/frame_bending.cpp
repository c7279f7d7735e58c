#include "knot_utm/sim/frame_bending.hpp"

#include <cmath>

#include "axes.hpp"
#include "knot_utm/numeric/index.hpp"
#include "knot_utm/rod/bending.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod_laws.hpp"
#include "knot_utm/rod/turning_angle.hpp"
#include "knot_utm/sim/linear_system.hpp"
#include "knot_utm/sim/step_matrix.hpp"

namespace knot_utm {

namespace {

Lanes across(const Lanes& w, const Lanes& t) { return w - dot(w, t) * t; }

}  // namespace

FrameBending::FrameBending(const RodProperties& rod) : rod_(rod), own_(own_numbers(rod.laws->bending)) {}

FrameBending::Curvature FrameBending::first(int i) const {
  return {m1_[at(i - 1)], m1_[at(i)], m2_[at(i - 1)], m2_[at(i)]};
}
FrameBending::Curvature FrameBending::second(int i) const {
  return {m2_[at(i - 1)], m2_[at(i)], -1.0 * m1_[at(i - 1)], -1.0 * m1_[at(i)]};
}
FrameBending::Curvature FrameBending::both(int i) const {
  const Eigen::Vector2d& m = nodes_[at(i)].law.moment;
  const Curvature a = first(i), b = second(i);
  return {m[0] * a.p + m[1] * b.p, m[0] * a.q + m[1] * b.q, m[0] * a.dp + m[1] * b.dp, m[0] * a.dq + m[1] * b.dq};
}

/// dkappa of kappa = s (v . p - u . q).
FrameBending::Slope FrameBending::slope(const Node& at, const Curvature& k) {
  const double n = dot(at.v, k.p) - dot(at.u, k.q);
  const Lanes in_u = (at.s_c * n) * at.v - at.s * (at.c * k.p + k.q);
  const Lanes in_v = (at.s_c * n) * at.u + at.s * (k.p + at.c * k.q);
  const Lanes e = at.over_e * across(in_u, at.u), f = at.over_f * across(in_v, at.v);
  return {{(at.s * dot(at.v, k.dp)) * kSpin - e, e - f - (at.s * dot(at.u, k.dq)) * kSpin, f}};
}

void FrameBending::evaluate(const RodState& start, double dt, const std::vector<Lanes>& tangent,
                            const std::vector<double>& inverse_length, const Points& director,
                            const std::vector<double>& angle) {
  const int edges = static_cast<int>(rod_.edges());
  m1_.resize(at(edges));
  m2_.resize(at(edges));
  nodes_.resize(at(edges));
  for (int j = 0; j < edges; ++j) {
    const Directors of = material_directors(to_vec3(tangent[at(j)]), director.col(j), angle[at(j)]);
    m1_[at(j)] = to_lanes(of.m1);
    m2_[at(j)] = to_lanes(of.m2);
  }
  const auto evaluate_node = [&](const auto& law, int i) {
    Node& node = nodes_[at(i)];
    node.u = tangent[at(i - 1)];
    node.v = tangent[at(i)];
    node.over_e = inverse_length[at(i - 1)];
    node.over_f = inverse_length[at(i)];
    node.c = dot(node.u, node.v);
    const Lanes apart = node.v - node.u;
    const double w = 0.25 * dot(apart, apart), pole = 1.0 / (1.0 - w);
    const SquaredAngleOverW<double> over = squared_angle_over(w);
    // 16 s^2 = G/(1 - w), and its derivatives in w; dw/dc = -1/2.
    const double square = over.value * pole, square_w = (over.first + square) * pole;
    const double square_ww = (over.second + 2.0 * square_w) * pole;
    node.s = 0.25 * std::sqrt(square);
    const double s_w = square_w / (32.0 * node.s), s_ww = (square_ww / 32.0 - s_w * s_w) / node.s;
    node.s_c = -0.5 * s_w;
    node.s_cc = 0.25 * s_ww;
    const Curvature k_1 = first(i), k_2 = second(i);
    const Eigen::Vector2d bend = {node.s * (dot(node.v, k_1.p) - dot(node.u, k_1.q)),
                                  node.s * (dot(node.v, k_2.p) - dot(node.u, k_2.q))};
    const double whole = i == parted_ || i == parted_ + 1 ? 0.0 : 1.0;
    const Eigen::Vector2d before =
        first_trial_ ? Eigen::Vector2d::Zero() : Eigen::Vector2d(node.bend.bend - node.bend.natural);
    node.bend = {whole * rod_.material.bending_stiffness,
                 rod_.voronoi_length[i],
                 bend,
                 start.natural_curvature.col(i - 1),
                 dt,
                 start.bending_own.data() + own_ * (i - 1),
                 0.0,
                 before};
    node.law = law.respond(node.bend);
    node.slope[0] = slope(node, k_1);
    node.slope[1] = slope(node, k_2);
  };
  std::visit(
      [&](const auto& law) {
        for (int i = 1; i < edges; ++i) evaluate_node(law, i);
      },
      rod_.laws->bending);
  first_trial_ = false;
}

void FrameBending::add_forces(std::vector<Lanes>& force, std::vector<double>& torque) const {
  for (std::size_t i = 1; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const Lanes gradient = node.law.moment[0] * node.slope[0].node[k] + node.law.moment[1] * node.slope[1].node[k];
      force[i - 1 + k] -= gradient;
      if (k < 2) torque[i - 1 + k] += gradient[3];
    }
  }
}

/// The Hessian of one curvature, by the formulas of bending.hpp in lanes. Of two vectors that are projected along the
/// tangent of their edge, as the curvature of the unit sphere asks, the names end in _u or _v.
void FrameBending::add_curvature_terms(const Node& at, const Curvature& k, StepMatrix<4>& matrix, int i) {
  const Lanes &u = at.u, &v = at.v;
  const double c = at.c, s = at.s, s_c = at.s_c, over_e = at.over_e, over_f = at.over_f;
  const double n = dot(v, k.p) - dot(u, k.q);
  const Lanes n_u = -1.0 * (c * k.p + k.q), n_v = k.p + c * k.q;  // dN/du, dN/dv
  const Lanes in_u = s * n_u + (s_c * n) * v, in_v = s * n_v + (s_c * n) * u;
  const Lanes v_u = v - c * u, u_v = u - c * v;
  const double in_u_along = dot(in_u, u), in_v_along = dot(in_v, v);
  const Lanes in_u_u = in_u - in_u_along * u, in_v_v = in_v - in_v_along * v;
  const Lanes a = across(s_c * n_u - (0.5 * s) * k.p, u), a_v = a + (at.s_cc * n) * v_u;
  const Lanes b = across(s_c * n_v + (0.5 * s) * k.q, v), b_u = b + (at.s_cc * n) * u_v;
  const Lanes right = s * k.q + s_c * across(n_v, v) + (at.s_cc * n) * u_v;  // beside v_u
  const Lanes left = s_c * across(n_u, u) - s * k.p;                         // beside u_v
  const Lanes on_u = in_u_along * u - in_u_u, on_v = in_v_along * v - in_v_v;
  const double ee = over_e * over_e, ff = over_f * over_f, ef = over_e * over_f, round = s_c * n;
  const Lanes e_theta_e = over_e * (s_c * dot(v, k.dp) * v_u - (s * c) * k.dp);
  const Lanes e_theta_f = over_e * across(-s_c * dot(u, k.dq) * v - s * k.dq, u);
  const Lanes f_theta_e = over_f * across(s_c * dot(v, k.dp) * u + s * k.dp, v);
  const Lanes f_theta_f = over_f * ((s * c) * k.dq - s_c * dot(u, k.dq) * u_v);
  const auto block = [&](int row, int column) -> Block<4>& { return matrix.band(i - 1, row, column); };
  Block<4>&b00 = block(0, 0), &b01 = block(0, 1), &b02 = block(0, 2), &b10 = block(1, 0), &b11 = block(1, 1),
  &b12 = block(1, 2), &b20 = block(2, 0), &b21 = block(2, 1), &b22 = block(2, 2);
  for (int j = 0; j < 3; ++j) {
    const Lanes h_ee = ee * (a * v_u[j] + v_u * a_v[j] + on_u * u[j] - u * in_u_u[j] - in_u_along * kAxis[j]);
    const Lanes h_ff = ff * (b * u_v[j] + u_v * b_u[j] + on_v * v[j] - v * in_v_v[j] - in_v_along * kAxis[j]);
    const Lanes h_ef = ef * (v_u * right[j] + left * u_v[j] + round * (kAxis[j] - u * u[j] + (c * u - v) * v[j]));
    const Lanes h_fe = ef * (right * v_u[j] + u_v * left[j] + round * (kAxis[j] - v * v[j] + (c * v - u) * u[j]));
    b00.column[j] += h_ee - e_theta_e[j] * kSpin;
    b01.column[j] += h_ef - h_ee + (e_theta_e[j] - f_theta_e[j]) * kSpin;
    b02.column[j] += f_theta_e[j] * kSpin - h_ef;
    b10.column[j] += h_fe - h_ee - e_theta_f[j] * kSpin;
    b11.column[j] += h_ee - h_ef - h_fe + h_ff + (e_theta_f[j] - f_theta_f[j]) * kSpin;
    b12.column[j] += h_ef - h_ff + f_theta_f[j] * kSpin;
    b20.column[j] -= h_fe;
    b21.column[j] += h_fe - h_ff;
    b22.column[j] += h_ff;
  }
  b00.column[3] += (-s * dot(v, k.p)) * kSpin - e_theta_e;
  b01.column[3] -= e_theta_f;
  b10.column[3] += e_theta_e - f_theta_e;
  b11.column[3] += (s * dot(u, k.q)) * kSpin + e_theta_f - f_theta_f;
  b20.column[3] += f_theta_e;
  b21.column[3] += f_theta_f;
}

void FrameBending::add_stiffness(LinearSystem<4>& system) const {
  StepMatrix<4>& matrix = system.matrix;
  for (int i = 1; i < static_cast<int>(nodes_.size()); ++i) {
    const Node& node = nodes_[at(i)];
    add_curvature_terms(node, both(i), matrix, i);
    const Eigen::Matrix2d& t = node.law.tangent;
    const Eigen::Vector2d& beyond = node.law.beyond;
    if (beyond[0] != 0.0 || beyond[1] != 0.0)
      for (int k = 0; k < 3; ++k)
        system.right[at(i - 1 + k)] -= beyond[0] * node.slope[0].node[k] + beyond[1] * node.slope[1].node[k];
    for (int column = 0; column < 3; ++column) {
      const Lanes on_1 = t(0, 0) * node.slope[0].node[column] + t(0, 1) * node.slope[1].node[column];
      const Lanes on_2 = t(1, 0) * node.slope[0].node[column] + t(1, 1) * node.slope[1].node[column];
      for (int row = 0; row < 3; ++row) {
        Block<4>& block = matrix.band(i - 1, row, column);
        for (int j = 0; j < 4; ++j)
          block.column[j] += node.slope[0].node[row] * on_1[j] + node.slope[1].node[row] * on_2[j];
      }
    }
  }
}

StencilMatrix FrameBending::hessian(int i) const {
  const Node& node = nodes_[at(i)];
  const auto directors = [&](int j) { return Directors{to_vec3(m1_[at(j)]), to_vec3(m2_[at(j)])}; };
  const CurvatureLocal bend =
      curvature_local(to_vec3(node.u) / node.over_e, to_vec3(node.v) / node.over_f, directors(i - 1), directors(i));
  return on_nodes(node.law, bend).hessian;
}

FrameBending::Energy FrameBending::energy(const Points& increment, const std::vector<double>& angle,
                                          const Eigen::VectorXd& start) const {
  Energy out;
  const auto turn = [&](int j) { return angle[at(j)] - start[j]; };
  const auto add_node = [&](const auto& law, int i) {
    const Node& node = nodes_[at(i)];
    const BendingMemory memory = law.remember(node.bend);
    out.stored += memory.stored;
    out.dissipated += memory.dissipated;
    for (int k = 0; k < 3; ++k) {
      const Lanes gradient = node.law.moment[0] * node.slope[0].node[k] + node.law.moment[1] * node.slope[1].node[k];
      out.along +=
          dot(gradient, to_lanes(Vec3(increment.col(i - 1 + k)))) + (k < 2 ? gradient[3] * turn(i - 1 + k) : 0.0);
    }
  };
  std::visit(
      [&](const auto& law) {
        for (int i = 1; i < static_cast<int>(nodes_.size()); ++i) add_node(law, i);
      },
      rod_.laws->bending);
  return out;
}

void FrameBending::commit(const std::vector<double>& tension, RodState& state) const {
  const auto keep = [&](const auto& law, int i) {
    BendingNode node = nodes_[at(i)].bend;
    node.tension = 0.5 * (tension[at(i - 1)] + tension[at(i)]);
    const BendingMemory memory = law.remember(node);
    if constexpr (std::decay_t<decltype(law)>::kOwn > 0) law.keep_own(node, state.bending_own.data() + own_ * (i - 1));
    state.natural_curvature.col(i - 1) = memory.natural;
  };
  std::visit(
      [&](const auto& law) {
        if constexpr (std::decay_t<decltype(law)>::kRemembers)
          for (int i = 1; i < static_cast<int>(nodes_.size()); ++i) keep(law, i);
      },
      rod_.laws->bending);
}

}  // namespace knot_utm
