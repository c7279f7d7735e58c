#include "knot_utm/sim/frame_bending.hpp"

#include <algorithm>
#include <cmath>

#include "knot_utm/numeric/fours.hpp"
#include "knot_utm/numeric/index.hpp"
#include "knot_utm/rod/bending.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod_laws.hpp"
#include "knot_utm/rod/thinned.hpp"
#include "knot_utm/rod/turning_angle.hpp"

namespace knot_utm {
namespace {

/// The bending law of every node. That of the ropes behind the first one is of the same kind.
template <typename Law>
struct LawOfNode {
  const Law &first, &others;
  std::size_t first_of_other;

  LawOfNode(const RodProperties& rod, const Law& law)
      : first(law),
        others(rod.other_laws ? std::get<Law>(rod.other_laws->bending) : law),
        first_of_other(static_cast<std::size_t>(rod.first_of_other())) {}
  const Law& operator[](std::size_t node) const { return node < first_of_other ? first : others; }
};

}  // namespace

FrameBending::FrameBending(const RodProperties& rod) : rod_(rod), own_(own_numbers(rod.laws->bending)) {}

void FrameBending::begin(const RodState& start, double dt) {
  nodes_.resize(at(static_cast<int>(rod_.edges())));
  for (int i = 1; i < static_cast<int>(nodes_.size()); ++i) {
    BendingNode& node = nodes_[at(i)];
    node.k_b = rod_.material_at(i).bending_stiffness;
    if (rod_.material.is_soft()) node.k_b *= thinned(rod_, start.position, i).bending;
    node.voronoi_length = rod_.voronoi_length[i];
    node.natural = start.natural_curvature.col(i - 1);
    node.dt = dt;
    node.own = start.bending_own.data() + own_ * (i - 1);
    node.bend = node.natural;  // no trial before the first one
  }
  for (const int cut : cuts_)
    for (const int i : {cut, cut + 1})
      if (i > 0 && i < static_cast<int>(nodes_.size())) nodes_[at(i)].k_b = 0.0;
}

/// m1 and m2 of every edge, as material_directors gives them.
void FrameBending::set_directors(const std::vector<FourPairs>& pairs, const std::vector<FourVectors>& director,
                                 const std::vector<double>& angle) {
  m1_.resize(director.size());
  m2_.resize(director.size());
  for (std::size_t g = 0; g < pairs.size(); ++g) {
    Lanes sine, cosine;
    for (std::size_t k = 0; k < 4; ++k) {
      sine[static_cast<int>(k)] = std::sin(angle[4 * g + k]);
      cosine[static_cast<int>(k)] = std::cos(angle[4 * g + k]);
    }
    const FourVectors &d1 = director[g], d2 = cross(pairs[g].u, d1);
    m1_[g] = cosine * d1 + sine * d2;
    m2_[g] = cosine * d2 - sine * d1;
  }
}

FrameBending::FourDirectors FrameBending::directors(std::size_t group) const {
  return {{m1_[group], m2_[group]}, {one_earlier(m1_[group], m1_[group + 1]), one_earlier(m2_[group], m2_[group + 1])}};
}

/// kappa = s N and its slopes, N = v . p - u . q.
void FrameBending::set_curvatures(const FourPairs& pair, const FourDirectors& directors, FourNodes& four,
                                  Lanes bend[2]) {
  const FourVectors &u = pair.u, &v = pair.v, apart = v - u;
  four.c = dot(u, v);
  const Lanes w = 0.25 * dot(apart, apart), pole = 1.0 / (1.0 - w);
  const SquaredAngleOverW<Lanes> over = squared_angle_over(w);
  // 16 s^2 = G/(1 - w), and its derivatives in w; dw/dc = -1/2.
  const Lanes square = over.value * pole, square_w = (over.first + square) * pole;
  const Lanes square_ww = (over.second + 2.0 * square_w) * pole;
  const Lanes s = 0.25 * square_root(square), over_s = 1.0 / s;
  const Lanes s_w = (1.0 / 32.0) * square_w * over_s, s_ww = ((1.0 / 32.0) * square_ww - s_w * s_w) * over_s;
  four.s = s;
  four.s_c = -0.5 * s_w;
  four.s_cc = 0.25 * s_ww;
  four.v_u = v - four.c * u;
  four.u_v = u - four.c * v;
  Lanes v_p[2], u_q[2];
  for (int k = 0; k < 2; ++k) {
    const FourVectors &p = directors.p[k], &q = directors.q[k];
    v_p[k] = dot(v, p);
    u_q[k] = dot(u, q);
    const Lanes n = v_p[k] - u_q[k], turning = four.s_c * n;
    bend[k] = s * n;
    // The parts of N_u and N_v across their edges: p is normal to u, and q to v.
    const FourVectors n_u = u_q[k] * u - four.c * p - q, n_v = p + four.c * q - v_p[k] * v;
    const FourVectors e = pair.over_e * (s * n_u + turning * four.v_u),
                      f = pair.over_f * (s * n_v + turning * four.u_v);
    for (int r = 0; r < 3; ++r) {
      four.slope[k].of[kOfE + r] = e[r];
      four.slope[k].of[kOfF + r] = f[r];
    }
  }
  // m1' = m2, m2' = -m1
  four.slope[0].of[kThetaE] = s * v_p[1];
  four.slope[0].of[kThetaF] = -s * u_q[1];
  four.slope[1].of[kThetaE] = -s * v_p[0];
  four.slope[1].of[kThetaF] = s * u_q[0];
}

template <typename Laws>
void FrameBending::respond(const Laws& law_of, const Lanes bend[2], std::size_t group) {
  // Gathered as numbers: a register that is written lane by lane in memory would be slow to read.
  double moment[2][4] = {}, beyond[2][4] = {}, tangent[3][4] = {};
  const std::size_t first = 4 * group + 1;
  for (std::size_t i = first; i < std::min(first + 4, nodes_.size()); ++i) {
    const std::size_t k = i - first;
    BendingNode& node = nodes_[i];
    node.before = node.bend - node.natural;
    node.bend = {bend[0][k], bend[1][k]};
    const BendingResponse response = law_of[i].respond(node);
    for (int m = 0; m < 2; ++m) {
      moment[m][k] = response.moment[m];
      beyond[m][k] = response.beyond[m];
    }
    tangent[0][k] = response.tangent(0, 0);
    tangent[1][k] = response.tangent(0, 1);
    tangent[2][k] = response.tangent(1, 1);
  }
  FourNodes& four = fours_[group];
  const auto lanes = [](const double* of) { return Lanes{of[0], of[1], of[2], of[3]}; };
  four.jumps = false;
  for (int m = 0; m < 2; ++m) {
    four.moment[m] = lanes(moment[m]);
    four.beyond[m] = lanes(beyond[m]);
    four.jumps = four.jumps || any(four.beyond[m] < 0.0) || any(four.beyond[m] > 0.0);
  }
  for (int m = 0; m < 3; ++m) four.tangent[m] = lanes(tangent[m]);
}

void FrameBending::evaluate(const std::vector<FourPairs>& pairs, const std::vector<FourVectors>& director,
                            const std::vector<double>& angle, std::vector<FourSlopes>& slopes) {
  set_directors(pairs, director, angle);
  fours_.resize(pairs.size());
  const auto evaluate_four = [&](const auto& law_of, std::size_t g) {
    Lanes bend[2];
    set_curvatures(pairs[g], directors(g), fours_[g], bend);
    respond(law_of, bend, g);
    for (int k = 0; k < 2; ++k) slopes[g] += fours_[g].moment[k] * fours_[g].slope[k];
  };
  std::visit(
      [&](const auto& law) {
        const LawOfNode law_of(rod_, law);
        for (std::size_t g = 0; g < fours_.size(); ++g) evaluate_four(law_of, g);
      },
      rod_.laws->bending);
}

/// The Hessian of one curvature by the formulas of bending.hpp, then the terms of the law's tangent. Vectors across
/// their edge, as the curvature of the unit sphere asks, end in _u or _v.
void FrameBending::add_stiffness(const FourPairs& pair, std::size_t group, FourCurves& curves) const {
  const FourNodes& four = fours_[group];
  const FourVectors &u = pair.u, &v = pair.v, &v_u = four.v_u, &u_v = four.u_v;
  const Lanes &c = four.c, &s = four.s, &s_c = four.s_c, &m_1 = four.moment[0], &m_2 = four.moment[1];
  const FourDirectors of = directors(group);
  const FourVectors p = m_1 * of.p[0] + m_2 * of.p[1], dp = m_1 * of.p[1] - m_2 * of.p[0];
  const FourVectors q = m_1 * of.q[0] + m_2 * of.q[1], dq = m_1 * of.q[1] - m_2 * of.q[0];
  const Lanes v_p = dot(v, p), u_q = dot(u, q), v_dp = dot(v, dp), u_dq = dot(u, dq);
  const Lanes n = v_p - u_q, round = s_c * n, half_curve = 0.5 * four.s_cc * n;
  const FourVectors n_u = u_q * u - c * p - q, n_v = p + c * q - v_p * v;
  // Beside v_u and u_v, and beside u and v. With u . p = v . q = 0, along_e = u . dkappa/du.
  const FourVectors a = s_c * n_u - (0.5 * s) * p + half_curve * v_u, b = s_c * n_v + (0.5 * s) * q + half_curve * u_v;
  const Lanes along_e = round * c - s * u_q, along_f = round * c + s * v_p;
  const FourVectors on_u = (0.5 * along_e) * u - s * n_u - round * v_u,
                    on_v = (0.5 * along_f) * v - s * n_v - round * u_v;
  const FourVectors right = s * q + s_c * n_v + (2.0 * half_curve) * u_v - round * v, left = s_c * n_u - s * p;
  const FourVectors round_u = round * u;
  const Lanes ee = pair.over_e * pair.over_e, ff = pair.over_f * pair.over_f, ef = pair.over_e * pair.over_f;
  // By theta: p turns to dp, and what is along an edge is left out.
  const FourVectors e_e = pair.over_e * ((s_c * v_dp) * v_u - (s * c) * dp);
  const FourVectors e_f = pair.over_e * ((s * u_dq) * u - (s_c * u_dq) * v_u - s * dq);
  const FourVectors f_e = pair.over_f * ((s_c * v_dp) * u_v + s * dp - (s * v_dp) * v);
  const FourVectors f_f = pair.over_f * ((s * c) * dq - (s_c * u_dq) * u_v);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const bool diagonal = i == j;
      Lanes across = v_u[i] * right[j] + left[i] * u_v[j] - round_u[i] * u[j];
      if (diagonal) across += round;
      curves.of[kOfE + i][kOfF + j] += ef * across;
      if (j < i) continue;
      Lanes of_e = a[i] * v_u[j] + v_u[i] * a[j] + on_u[i] * u[j] + u[i] * on_u[j];
      Lanes of_f = b[i] * u_v[j] + u_v[i] * b[j] + on_v[i] * v[j] + v[i] * on_v[j];
      if (diagonal) of_e -= along_e;
      if (diagonal) of_f -= along_f;
      curves.of[kOfE + i][kOfE + j] += ee * of_e;
      curves.of[kOfF + i][kOfF + j] += ff * of_f;
    }
    curves.of[kOfE + i][kThetaE] += e_e[i];
    curves.of[kOfE + i][kThetaF] += e_f[i];
    curves.of[kThetaE][kOfF + i] += f_e[i];
    curves.of[kOfF + i][kThetaF] += f_f[i];
  }
  curves.of[kThetaE][kThetaE] -= s * v_p;
  curves.of[kThetaF][kThetaF] += s * u_q;
  const Lanes *slope_1 = four.slope[0].of, *slope_2 = four.slope[1].of;
  for (int j = 0; j < 8; ++j) {
    const Lanes on_1 = four.tangent[0] * slope_1[j] + four.tangent[1] * slope_2[j];
    const Lanes on_2 = four.tangent[1] * slope_1[j] + four.tangent[2] * slope_2[j];
    for (int i = 0; i <= j; ++i) curves.of[i][j] += slope_1[i] * on_1 + slope_2[i] * on_2;
  }
}

void FrameBending::add_beyond(std::vector<Lanes>& right) const {
  for (std::size_t g = 0; g < fours_.size(); ++g) {
    const FourNodes& four = fours_[g];
    if (!four.jumps) continue;
    FourSlopes slopes = four.beyond[0] * four.slope[0];
    slopes += four.beyond[1] * four.slope[1];
    const std::size_t first = 4 * g + 1;
    subtract_slopes(slopes, static_cast<int>(first), static_cast<int>(std::min<std::size_t>(4, nodes_.size() - first)),
                    right);
  }
}

StencilMatrix FrameBending::hessian(const FourPairs& pair, int i) const {
  const FourNodes& four = fours_[at(i - 1) / 4];
  const FourDirectors of = directors(at(i - 1) / 4);
  const int k = (i - 1) % 4;
  const auto one = [&](const FourVectors& four_of) { return Vec3(four_of.x[k], four_of.y[k], four_of.z[k]); };
  const CurvatureLocal bend = curvature_local(one(pair.u) / pair.over_e[k], one(pair.v) / pair.over_f[k],
                                              {one(of.p[0]), one(of.p[1])}, {one(of.q[0]), one(of.q[1])});
  BendingResponse law;
  law.energy = 0.0;
  law.moment = {four.moment[0][k], four.moment[1][k]};
  law.tangent << four.tangent[0][k], four.tangent[1][k], four.tangent[1][k], four.tangent[2][k];
  return on_nodes(law, bend).hessian;
}

FrameBending::Energy FrameBending::energy() const {
  Energy out;
  std::visit(
      [&](const auto& law) {
        const LawOfNode law_of(rod_, law);
        for (std::size_t i = 1; i < nodes_.size(); ++i) {
          const BendingMemory memory = law_of[i].remember(nodes_[i]);
          out.stored += memory.stored;
          out.dissipated += memory.dissipated;
        }
      },
      rod_.laws->bending);
  return out;
}

void FrameBending::commit(const std::vector<double>& tension, RodState& state) const {
  const auto keep = [&](const auto& law, int i) {
    BendingNode node = nodes_[at(i)];
    node.tension = 0.5 * (tension[at(i - 1)] + tension[at(i)]);
    const BendingMemory memory = law.remember(node);
    if constexpr (std::decay_t<decltype(law)>::kOwn > 0) law.keep_own(node, state.bending_own.data() + own_ * (i - 1));
    state.natural_curvature.col(i - 1) = memory.natural;
  };
  std::visit(
      [&](const auto& law) {
        if constexpr (std::decay_t<decltype(law)>::kRemembers) {
          const LawOfNode law_of(rod_, law);
          for (int i = 1; i < static_cast<int>(nodes_.size()); ++i) keep(law_of[at(i)], i);
        }
      },
      rod_.laws->bending);
}

}  // namespace knot_utm
