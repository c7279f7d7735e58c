#include "knot_utm/machine/fracture.hpp"

#include <algorithm>
#include <cmath>

#include "knot_utm/rod/stretching.hpp"
#include "knot_utm/rod/turning_angle.hpp"

namespace knot_utm {

namespace {

constexpr double kTouching = 2.2;   // [h]
constexpr double kNeighbour = 5.0;  // along the rod [h]

/// kappa of an inner node of a rope.
double curvature(const RodProperties& rod, const Points& position, Eigen::Index node) {
  if (node < 1 || node + 1 >= rod.nodes() || rod.is_cut(node - 1) || rod.is_cut(node)) return 0.0;
  const Vec3 e = (position.col(node) - position.col(node - 1)).normalized();
  const Vec3 f = (position.col(node + 1) - position.col(node)).normalized();
  return turning_angle(e, f) / rod.voronoi_length[node];
}

}  // namespace

bool can_part(const Material& material) { return material.breaking_force || material.breaking_strain; }

Exposure most_exposed(const Material& material, const RodProperties& rod, const Points& position) {
  Exposure out;
  double bend_before = 0.0;
  for (Eigen::Index j = 0; j < rod.edges(); ++j) {
    if (rod.is_cut(j)) continue;
    const StretchedEdge stretched = stretched_edge(rod, position, j);
    const double tension = respond(rod, stretched).tension;
    Exposure edge;
    if (material.breaking_force)
      edge = {tension / *material.breaking_force, static_cast<int>(j), BreakLimit::kForce, tension};
    if (material.breaking_strain) {
      const double bend = curvature(rod, position, j + 1);
      const double strain = stretched.stretch - 1.0 + material.radius * std::max(bend, bend_before);
      const double fraction = strain / *material.breaking_strain;
      if (fraction > edge.fraction) edge = {fraction, static_cast<int>(j), BreakLimit::kStrain, strain};
      bend_before = bend;
    }
    if (edge.fraction > out.fraction) out = edge;
  }
  return out;
}

double transit_time(const RodMaterial& material, double length) {
  const double mass = material.density * M_PI * material.radius * material.radius;
  return length * std::sqrt(mass / material.stretching_stiffness);
}

bool lies_in_knot(const RodProperties& rod, const Points& position, int edge) {
  const Eigen::VectorXd arclength = rod.arclength();
  const auto middle = [&](Eigen::Index j) -> Vec3 { return 0.5 * (position.col(j) + position.col(j + 1)); };
  const double h = rod.material.radius;
  for (Eigen::Index j = 0; j < rod.edges(); ++j) {
    if (rod.is_cut(j) || std::abs(arclength[j] - arclength[edge]) <= kNeighbour * h) continue;
    const double reach = kTouching * h + 0.5 * rod.rest_length[j];
    if ((middle(j) - middle(edge)).squaredNorm() < reach * reach) return true;
  }
  return false;
}

}  // namespace knot_utm
