#include "knot_utm/rod/energy.hpp"

#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/isotropic_bending.hpp"
#include "knot_utm/rod/stretching.hpp"
#include "knot_utm/rod/thinned.hpp"

namespace knot_utm {
namespace {

bool has_frame(const RodState& state) { return state.twist.size() > 0; }

bool ends_at_cut(const RodProperties& rod, Eigen::Index node) { return rod.is_cut(node - 1) || rod.is_cut(node); }

double stretching_energy(const RodProperties& rod, const RodState& state) {
  double sum = 0.0;
  for (Eigen::Index j = 0; j < rod.edges(); ++j)
    if (!rod.is_cut(j)) sum += respond(rod, j, stretched_edge(rod, state.position, j)).energy;
  return sum;
}

double isotropic_bending_energy(const RodProperties& rod, const Points& x) {
  double sum = 0.0;
  for (Eigen::Index i = 1; i + 1 < rod.nodes(); ++i) {
    if (ends_at_cut(rod, i)) continue;
    const double left = rod.material.is_soft() ? thinned(rod, x, i).bending : 1.0;
    sum += isotropic_bending_gradient(left * rod.material_at(i).bending_stiffness, rod.voronoi_length[i],
                                      x.col(i) - x.col(i - 1), x.col(i + 1) - x.col(i))
               .energy;
  }
  return sum;
}

}  // namespace

InnerNode inner_node(const RodProperties& rod, const RodState& state, Eigen::Index i) {
  InnerNode node;
  node.e = state.position.col(i) - state.position.col(i - 1);
  node.f = state.position.col(i + 1) - state.position.col(i);
  node.on_e = material_directors(node.e.normalized(), state.reference_director.col(i - 1), state.twist[i - 1]);
  node.on_f = material_directors(node.f.normalized(), state.reference_director.col(i), state.twist[i]);
  node.twist = state.twist[i] - state.twist[i - 1] + state.reference_twist[i - 1];
  const Thinned left = rod.material.is_soft() ? thinned(rod, state.position, i) : Thinned();
  node.bending.k_b = left.bending * rod.material_at(i).bending_stiffness;
  node.bending.voronoi_length = rod.voronoi_length[i];
  if (state.curved_at_rest()) node.bending.natural_curvature = state.natural_curvature.col(i - 1);
  node.twisting.k_t = left.twisting * rod.material_at(i).twisting_stiffness;
  node.twisting.voronoi_length = rod.voronoi_length[i];
  return node;
}

ElasticEnergy elastic_energy(const RodProperties& rod, const RodState& state) {
  ElasticEnergy energy;
  energy.stretching = stretching_energy(rod, state);
  if (!state.curved_at_rest()) energy.bending = isotropic_bending_energy(rod, state.position);
  if (!has_frame(state)) return energy;
  const Eigen::Index own = own_numbers(rod.laws->bending);
  const auto add_node = [&](const InnerNode& node, const double* remembered, const auto& bending) {
    energy.twisting += twisting_energy(node.twisting, node.twist);
    if (!state.curved_at_rest()) return;
    const Eigen::Vector2d bend = material_curvature(node.e, node.f, node.on_e, node.on_f);
    energy.bending += bending
                          .respond({node.bending.k_b, node.bending.voronoi_length, bend, node.bending.natural_curvature,
                                    0.0, remembered})
                          .energy;
  };
  for (Eigen::Index i = 1; i + 1 < rod.nodes(); ++i) {
    if (ends_at_cut(rod, i)) continue;
    std::visit(
        [&](const auto& law) { add_node(inner_node(rod, state, i), state.bending_own.data() + own * (i - 1), law); },
        rod.laws_at(i).bending);
  }
  return energy;
}

Eigen::VectorXd edge_tension(const RodProperties& rod, const RodState& state) {
  Eigen::VectorXd tension(rod.edges());
  for (Eigen::Index j = 0; j < rod.edges(); ++j)
    tension[j] = respond(rod, j, stretched_edge(rod, state.position, j)).tension;
  return tension;
}

}  // namespace knot_utm
