#include "knot_utm/rod/energy.hpp"

#include <string>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/isotropic_bending.hpp"
#include "knot_utm/rod/stretching.hpp"

namespace knot_utm {

namespace {

bool has_frame(const RodState& state) { return state.twist.size() > 0; }

void expect_size(const char* key, Eigen::Index size, Eigen::Index expected) {
  if (size != expected)
    throw InvalidInput::sentence(
        key, std::to_string(size),
        std::string(key) + " has " + std::to_string(size) + " values, but must have " + std::to_string(expected));
}

void check(const RodProperties& rod, const RodState& state) {
  expect_size("state.position", state.position.cols(), rod.nodes());
  const Eigen::Index inner = rod.nodes() - 2;
  if (state.curved_at_rest()) expect_size("state.natural_curvature", state.natural_curvature.cols(), inner);
  if (rod.natural_twist.size() > 0) expect_size("rod.natural_twist", rod.natural_twist.size(), inner);
  if (has_frame(state)) {
    expect_size("state.twist", state.twist.size(), rod.edges());
    expect_size("state.reference_director", state.reference_director.cols(), rod.edges());
    expect_size("state.reference_twist", state.reference_twist.size(), inner);
  } else if (state.curved_at_rest() || rod.natural_twist.size() > 0) {
    throw InvalidInput("state.twist", "empty", "given for a rod with natural curvature or twist");
  }
}

double stretching_energy(const RodProperties& rod, const Points& x) {
  double sum = 0.0;
  for (Eigen::Index j = 0; j < rod.edges(); ++j) sum += respond(rod, stretched_edge(rod, x, j)).energy;
  return sum;
}

double isotropic_bending_energy(const RodProperties& rod, const Points& x) {
  double sum = 0.0;
  for (Eigen::Index i = 1; i + 1 < rod.nodes(); ++i) {
    sum += isotropic_bending_gradient(rod.material.bending_stiffness, rod.voronoi_length[i], x.col(i) - x.col(i - 1),
                                      x.col(i + 1) - x.col(i))
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
  node.bending.k_b = rod.material.bending_stiffness;
  node.bending.voronoi_length = rod.voronoi_length[i];
  if (state.curved_at_rest()) node.bending.natural_curvature = state.natural_curvature.col(i - 1);
  node.twisting.k_t = rod.material.twisting_stiffness;
  node.twisting.voronoi_length = rod.voronoi_length[i];
  if (rod.natural_twist.size() > 0) node.twisting.natural_twist = rod.natural_twist[i - 1];
  return node;
}

ElasticEnergy elastic_energy(const RodProperties& rod, const RodState& state) {
  check(rod, state);
  ElasticEnergy energy;
  energy.stretching = stretching_energy(rod, state.position);
  const bool straight_at_rest = !state.curved_at_rest();
  if (straight_at_rest) energy.bending = isotropic_bending_energy(rod, state.position);
  if (!has_frame(state)) return energy;
  for (Eigen::Index i = 1; i + 1 < rod.nodes(); ++i) {
    const InnerNode node = inner_node(rod, state, i);
    if (!straight_at_rest) energy.bending += bending_energy(node.bending, node.e, node.f, node.on_e, node.on_f);
    energy.twisting += twisting_energy(node.twisting, node.twist);
  }
  return energy;
}

Eigen::VectorXd edge_tension(const RodProperties& rod, const Points& position) {
  Eigen::VectorXd tension(rod.edges());
  for (Eigen::Index j = 0; j < rod.edges(); ++j) tension[j] = respond(rod, stretched_edge(rod, position, j)).tension;
  return tension;
}

}  // namespace knot_utm
