#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "knot_utm/contact/surface_contact.hpp"

namespace knot_utm {

/// Derivatives of the spin Psi of a section with respect to the positions of its three nodes.
inline std::array<Lanes, 3> spin_of_nodes(const std::vector<Lanes>& pull, int first, const double* s) {
  const auto edge = static_cast<std::size_t>(first);
  const Lanes before = s[0] * pull[edge], behind = s[1] * pull[edge + 1];
  return {before, behind - before, -1.0 * behind};
}

/// The derivative of a contact's forces with respect to one unknown of a node: a weighted sum of
/// SurfaceModel::Response.
struct SurfaceColumn : SurfaceModel::Response {
  SurfaceColumn() = default;
  SurfaceColumn(double times, const SurfaceModel::Response& r) : SurfaceModel::Response(r) {
    force = times * force;
    on_a = times * on_a;
    on_b = times * on_b;
    foot *= times;
  }

  void add(double times, const SurfaceModel::Response& r) {
    force += times * r.force;
    on_a += times * r.on_a;
    on_b += times * r.on_b;
    foot += times * r.foot;
  }
};

/// The four columns of a node: three for its position and one for its spin. c and d are the weights of the node in S
/// and in V of its section, and `spin_weight` is that of its own spin.
inline std::array<SurfaceColumn, 4> columns_of(const SurfaceModel& model, int turn, int spin, double c, double d,
                                               const Lanes& spin_of_node, double spin_weight) {
  std::array<SurfaceColumn, 4> out;
  for (std::size_t i = 0; i < 3; ++i) {
    out[i] = SurfaceColumn(c, model.by[SurfaceModel::kShift + static_cast<int>(i)]);
    out[i].add(d, model.by[turn + static_cast<int>(i)]);
    out[i].add(spin_of_node[static_cast<int>(i)], model.by[spin]);
  }
  out[3] = SurfaceColumn(spin_weight, model.by[spin]);
  return out;
}

}  // namespace knot_utm
