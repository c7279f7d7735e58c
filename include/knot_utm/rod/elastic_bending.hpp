#pragma once

#include "knot_utm/numeric/law_registry.hpp"
#include "knot_utm/rod/bending_law.hpp"

namespace knot_utm {

struct RodMaterial;

/// E = k_b/(2 lbar) |kappa - kappabar|^2: the rod springs back to its natural curvature. A rod without natural
/// curvature bends by the same law without frames (isotropic_bending.hpp).
struct ElasticBending {
  static constexpr const char* kName = "elastic";
  static constexpr NoKeys kKeys{};
  static constexpr bool kStudied = true;
  static constexpr bool kRemembers = false;
  static constexpr int kOwn = 0;

  static ElasticBending of(const RodMaterial& /*material*/) { return {}; }

  BendingResponse respond(const BendingNode& node) const {
    const double stiffness = node.k_b / node.voronoi_length;
    const Eigen::Vector2d off = node.bend - node.natural;
    return {0.5 * stiffness * off[0] * off[0] + 0.5 * stiffness * off[1] * off[1], stiffness * off,
            stiffness * Eigen::Matrix2d::Identity()};
  }
  BendingMemory remember(const BendingNode& node) const { return {node.natural, 0.0, respond(node).energy}; }
};

}  // namespace knot_utm
