#pragma once

#include <algorithm>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/rod/rod_laws.hpp"

namespace knot_utm {

/// Stretching of one edge by a stretching law (stretching_law.hpp).
///
///   E = l0 W(lambda),   lambda = |e|/l0
///
///   e    edge vector x_{i+1} - x_i                 [m]
///   l0   length of the edge at rest                [m]
///   T    tension W', positive pulls                [N]
///   t    unit tangent e/|e|                        [-]
///
///   dE/de     = T t                                (force on x_i is +T t, on x_{i+1} is -T t)
///   d2E/de2   = T'/l0 t t^T + T/|e| (1 - t t^T)    (indefinite where the edge is compressed)
///
/// An edge of length zero has no tangent; the caller keeps |e| > 0.
/// Source: Bergou, Audoly, Vouga, Wardetzky, Grinspun 2010, section 4.2, there with the linear law.
struct StretchingLocal {
  double energy;  ///< [J]
  Vec3 gradient;  ///< dE/de [N]: +gradient on x_{i+1}, -gradient on x_i
  Mat3 hessian;   ///< d2E/de2 [N/m]: +hessian on (i,i) and (i+1,i+1), -hessian on (i,i+1)
};

template <typename Law>
StretchingLocal stretching(const Law& law, double k_s, double l0, const Vec3& edge) {
  const double length = edge.norm();
  const StretchingResponse response = law.respond(StretchedEdge{k_s, l0, length / l0});
  const Vec3 tangent = edge / length;
  const double across = response.tension / length;
  StretchingLocal local;
  local.energy = response.energy;
  local.gradient = response.tension * tangent;
  local.hessian.noalias() = (response.slope / l0 - across) * tangent * tangent.transpose();
  local.hessian.diagonal().array() += across;
  return local;
}

/// Edge j of a rod. A cut one has k_s = 0.
inline StretchedEdge stretched_edge(const RodProperties& rod, const Points& position, Eigen::Index j) {
  const Vec3 edge = position.col(j + 1) - position.col(j);
  const double k_s = rod.is_cut(j) ? 0.0 : rod.material_at(j).stretching_stiffness;
  return {k_s, rod.rest_length[j], edge.norm() / rod.rest_length[j]};
}

/// Response of the law of its rope to edge j.
inline StretchingResponse respond(const RodProperties& rod, Eigen::Index j, const StretchedEdge& edge) {
  return std::visit([&](const auto& law) { return law.respond(edge); }, rod.laws_at(j).stretching);
}

/// Calls use(law, begin, end) with the stretching law of each material, and the edges that are of it.
template <typename Use>
void each_stretching_law(const RodProperties& rod, const Use& use) {
  const auto edges = static_cast<std::size_t>(rod.edges());
  const std::size_t others = std::min(static_cast<std::size_t>(rod.first_of_other()), edges);
  std::visit([&](const auto& law) { use(law, std::size_t{0}, others); }, rod.laws->stretching);
  if (others < edges) std::visit([&](const auto& law) { use(law, others, edges); }, rod.other_laws->stretching);
}

}  // namespace knot_utm
