#include "knot_utm/sim/centreline_terms.hpp"

#include <algorithm>
#include <cmath>

#include "knot_utm/rod/isotropic_bending.hpp"
#include "knot_utm/rod/thinned.hpp"
#include "knot_utm/sim/force_term.hpp"

namespace knot_utm {
namespace {

constexpr Lanes kZero = {0.0, 0.0, 0.0, 0.0};

}  // namespace

CentrelineTerms::CentrelineTerms(const RodProperties& rod, bool bends)
    : rod_(rod),
      bends_(bends),
      stretching_stiffness_(static_cast<std::size_t>(rod.edges())),
      bending_stiffness_(static_cast<std::size_t>(rod.nodes())),
      tangent_(static_cast<std::size_t>(rod.edges())),
      inverse_length_(tangent_.size()),
      stretch_(tangent_.size()),
      tension_(tangent_.size()),
      slope_(tangent_.size()),
      predicted_tension_(tangent_.size()),
      cosine_(static_cast<std::size_t>(rod.nodes() + 3) / 4, constant<Lanes>(1.0)),
      bending_slope_(cosine_.size()),
      bending_curve_(cosine_.size()) {
  for (Eigen::Index j = 0; j < rod.edges(); ++j)
    stretching_stiffness_[static_cast<std::size_t>(j)] = rod.material_at(j).stretching_stiffness;
  take_lengths();
}

void CentrelineTerms::take_lengths() {
  for (Eigen::Index i = 0; i < rod_.nodes(); ++i)
    bending_stiffness_[static_cast<std::size_t>(i)] = rod_.material_at(i).bending_stiffness / rod_.voronoi_length[i];
  for (const std::size_t end : ends_of_cuts_) bending_stiffness_[end] = 0.0;
}

void CentrelineTerms::part(int edge) {
  const auto j = static_cast<std::size_t>(edge);
  stretching_stiffness_[j] = bending_stiffness_[j] = bending_stiffness_[j + 1] = 0.0;
  for (const std::size_t end : {j, j + 1})
    if (end > 0 && end < tangent_.size()) ends_of_cuts_.push_back(end);
}

void CentrelineTerms::begin(const StepStart& start, bool predicts) {
  if (bends_ && rod_.material.is_soft()) {
    take_lengths();
    for (std::size_t i = 1; i < tangent_.size(); ++i)
      bending_stiffness_[i] *= thinned(rod_, start.state.position, static_cast<Eigen::Index>(i)).bending;
  }
  predicts_ = predicts;
  if (!predicts) return;
  for (std::size_t j = 0; j < predicted_tension_.size(); ++j) {
    StretchedEdge edge = stretched_edge(rod_, start.state.position, static_cast<Eigen::Index>(j));
    edge.k_s = stretching_stiffness_[j];
    predicted_tension_[j] = respond(rod_, static_cast<Eigen::Index>(j), edge).tension;
  }
}

void CentrelineTerms::predict(const std::vector<Lanes>& change, double factor) {
  if (!predicts_) return;
  for (std::size_t j = 0; j < predicted_tension_.size(); ++j)
    predicted_tension_[j] = tension_[j] + factor * slope_[j] / rod_.rest_length[static_cast<Eigen::Index>(j)] *
                                              dot(tangent_[j], change[j + 1] - change[j]);
}

void CentrelineTerms::add_forces(const StepStart&, const Points& x, std::vector<Lanes>& force) {
  largest_tension_ = 0.0;
  each_stretching_law(rod_, [&](const auto& law, std::size_t begin, std::size_t end) {
    add_stretching_forces(law, begin, end, x, force);
  });
  if (bends_) add_bending_forces(force);
}

template <typename Law>
void CentrelineTerms::add_stretching_forces(const Law& law, std::size_t begin, std::size_t end, const Points& position,
                                            std::vector<Lanes>& force) {
  for (std::size_t j = begin; j < end; ++j) {
    const double* x = position.data() + 3 * j;
    const Lanes e = {x[3] - x[0], x[4] - x[1], x[5] - x[2], 0.0};
    const double length = std::sqrt(dot(e, e));
    inverse_length_[j] = 1.0 / length;
    tangent_[j] = inverse_length_[j] * e;
    stretch_[j] = length / rod_.rest_length[static_cast<Eigen::Index>(j)];
    const StretchingResponse response = law.respond(stretched(j));
    tension_[j] = response.tension;
    slope_[j] = response.slope;
    largest_tension_ = std::max(largest_tension_, std::abs(tension_[j]));
    const Lanes pull = tension_[j] * tangent_[j];
    force[j] += pull;
    force[j + 1] -= pull;
  }
}

void CentrelineTerms::add_bending_forces(std::vector<Lanes>& force) {
  const std::size_t edges = tangent_.size();
  for (std::size_t i = 1; i < edges; ++i) cosine_[i / 4][i % 4] = dot(tangent_[i - 1], tangent_[i]);
  // A cut edge may lie straight back along its rope, a turn whose slope is infinite.
  for (const std::size_t i : ends_of_cuts_) cosine_[i / 4][i % 4] = 1.0;
  for (std::size_t four = 0; four < cosine_.size(); ++four) {
    const auto slopes = BendingSlopes<Lanes>::at(cosine_[four]);
    bending_slope_[four] = slopes.first;
    bending_curve_[four] = slopes.second;
  }
  for (std::size_t i = 1; i < edges; ++i) {
    const Lanes &t_e = tangent_[i - 1], &t_f = tangent_[i];
    const double c = cosine_[i / 4][i % 4], slope = bending_stiffness_[i] * bending_slope_[i / 4][i % 4];
    const Lanes gradient_e = (slope * inverse_length_[i - 1]) * (t_f - c * t_e);
    const Lanes gradient_f = (slope * inverse_length_[i]) * (t_e - c * t_f);
    force[i - 1] += gradient_e;
    force[i] += gradient_f - gradient_e;
    force[i + 1] -= gradient_f;
  }
}

template <typename Law>
void CentrelineTerms::add_stretching_energy(const Law& law, std::size_t begin, std::size_t end, Energy& out) const {
  for (std::size_t j = begin; j < end; ++j)
    if (stretching_stiffness_[j] > 0.0) out.stretching += law.respond(stretched(j)).energy;
}

CentrelineTerms::Energy CentrelineTerms::energy(const Points& increment) const {
  Energy out;
  each_stretching_law(
      rod_, [&](const auto& law, std::size_t begin, std::size_t end) { add_stretching_energy(law, begin, end, out); });
  Lanes before = kZero;  // of the edge before: its change over its length
  for (std::size_t j = 0; j < tangent_.size(); ++j) {
    const double* w = increment.data() + 3 * j;
    const Lanes change = {w[3] - w[0], w[4] - w[1], w[5] - w[2], 0.0};
    out.along += tension_[j] * dot(tangent_[j], change);
    const Lanes turned = inverse_length_[j] * change;
    if (bends_ && j > 0 && bending_stiffness_[j] > 0.0) {
      const Lanes &t_e = tangent_[j - 1], &t_f = tangent_[j];
      const Lanes apart = t_f - t_e;
      const double c = cosine_[j / 4][j % 4], slope = bending_stiffness_[j] * bending_slope_[j / 4][j % 4];
      out.bending += 0.5 * bending_stiffness_[j] * bending_angle_squared(dot(apart, apart));
      out.along += slope * (dot(t_f - c * t_e, before) + dot(t_e - c * t_f, turned));
    }
    before = turned;
  }
  return out;
}

void CentrelineTerms::account(const SolvedStep& step, StepAccount& account) const {
  const Energy energy = this->energy(step.increment);
  account.energies.stretching += energy.stretching;
  account.energies.bending += energy.bending;
  account.work.numerical += energy.along;
}

CentrelineTerms::NodeHessian CentrelineTerms::bending_hessian(std::size_t node) const {
  const double c = cosine_[node / 4][node % 4], stiffness = bending_stiffness_[node];
  const double slope = stiffness * bending_slope_[node / 4][node % 4];  // W'
  const double curve = stiffness * bending_curve_[node / 4][node % 4];  // W''
  const double over_e = inverse_length_[node - 1], over_f = inverse_length_[node];
  const Lanes &t_e = tangent_[node - 1], &t_f = tangent_[node];
  const Lanes c_e = over_e * (t_f - c * t_e), c_f = over_f * (t_e - c * t_f);
  const double diagonal_e = slope * c * over_e * over_e, diagonal_f = slope * c * over_f * over_f;
  const double diagonal_ef = slope * over_e * over_f;
  // The rank-one terms are gathered by their right factor.
  const Lanes on_c_e = curve * c_e - (slope * over_e) * t_e, on_c_f = curve * c_f - (slope * over_f) * t_f;
  const Lanes on_t_e = diagonal_e * t_e - (slope * over_e) * c_e, on_t_f = diagonal_f * t_f - (slope * over_f) * c_f;
  const Lanes on_t_f_ef = -diagonal_ef * t_f;
  NodeHessian h;
  for (int k = 0; k < 3; ++k) {
    const Lanes across = on_t_f_ef * t_f[k] + diagonal_ef * kAxis[k];
    h.ee[k] = on_c_e * c_e[k] + on_t_e * t_e[k] - diagonal_e * kAxis[k];
    h.ff[k] = on_c_f * c_f[k] + on_t_f * t_f[k] - diagonal_f * kAxis[k];
    h.ef[k] = on_c_e * c_f[k] + across;
    h.fe[k] = c_f * on_c_e[k] + across;
  }
  return h;
}

template <int D>
void CentrelineTerms::add_stiffness(LinearSystem<D>& system) const {
  StepMatrix<D>& matrix = system.matrix;
  const std::size_t edges = tangent_.size(), nodes = edges + 1;
  const std::vector<double>& turning = predicts_ ? predicted_tension_ : tension_;
  // With A_j = d2E/de_j^2 and B_i = d2E/(de_{i-1} de_i), the latter of bending at node i, the nodes have
  //   (i,i)  A_{i-1} + A_i - B_i - B_i^T     (i,i+1)  B_i + B_{i+1} - A_i     (i,i+2)  -B_{i+1}
  NodeHessian here = {}, after = {};
  Lanes edge_before[3] = {kZero, kZero, kZero}, edge[3];
  for (std::size_t i = 0; i < nodes; ++i, here = after) {
    const auto& stencil = matrix.stencil(static_cast<int>(i));
    const bool last = i == edges;
    after = {};
    if (bends_ && i + 1 < edges) after = bending_hessian(i + 1);
    if (!last) {
      const double across = turning[i] * inverse_length_[i];
      const double along = slope_[i] / rod_.rest_length[static_cast<Eigen::Index>(i)] - across;
      const Lanes t = along * tangent_[i];
      for (int k = 0; k < 3; ++k) edge[k] = t * tangent_[i][k] + across * kAxis[k] + here.ff[k] + after.ee[k];
    } else {
      std::fill_n(edge, 3, kZero);
    }
    Block<D>& own = matrix.block(stencil[0]);
    own.set_zero();
    for (int k = 0; k < 3; ++k) own.column[k] = edge_before[k] + edge[k] - here.ef[k] - here.fe[k];
    if (last) return;
    Block<D>&next = matrix.block(stencil[1]), &next_back = matrix.block(stencil[3]);
    next.set_zero();
    next_back.set_zero();
    for (int k = 0; k < 3; ++k) {
      next.column[k] = here.ef[k] + after.ef[k] - edge[k];
      next_back.column[k] = here.fe[k] + after.fe[k] - edge[k];
      edge_before[k] = edge[k];
    }
    if (i + 1 == edges) continue;
    Block<D>&second = matrix.block(stencil[2]), &second_back = matrix.block(stencil[6]);
    second.set_zero();
    second_back.set_zero();
    for (int k = 0; k < 3; ++k) {
      second.column[k] = -after.ef[k];
      second_back.column[k] = -after.fe[k];
    }
  }
}

template void CentrelineTerms::add_stiffness(LinearSystem<3>&) const;
template void CentrelineTerms::add_stiffness(LinearSystem<4>&) const;

}  // namespace knot_utm
