#pragma once

#include <array>
#include <limits>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/law_keys.hpp"
#include "knot_utm/rod/bending_law.hpp"
#include "knot_utm/rod/material.hpp"
#include "knot_utm/rod/standard_solid.hpp"

namespace knot_utm {

/// M = k_b/lbar (kappa - kappabar) of a node that is bent fast, of which a share relaxes while the bend is held
/// (standard_solid.hpp). The natural curvature kappabar stays; the law's own two numbers are the bend of the dashpot,
/// on (m1, m2). A rod that was held bent and is let go comes back in two parts: most of it at once, and all of it in
/// the end.
struct ViscoelasticBending {
  static constexpr const char* kName = "viscoelastic";
  static constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
  static constexpr LawKey kShare{"bending_relaxation_share", 0.0, 0.99, "-", LawDefault::kNone, kNoValue};
  static constexpr LawKey kTime{"bending_relaxation_time", 1e-3, 1e9, "s", LawDefault::kNone, kNoValue};
  static constexpr std::array kKeys{kShare, kTime};
  static constexpr bool kStudied = false;
  static constexpr bool kRemembers = true;
  static constexpr bool kKeepsNatural = true;
  static constexpr int kOwn = 2;

  StandardSolid solid;

  static ViscoelasticBending of(const RodMaterial& material) {
    return {{material.bending.number(kShare), material.bending.number(kTime)}};
  }

  BendingResponse respond(const BendingNode& node) const {
    const double k = node.k_b / node.voronoi_length;
    const Eigen::Vector2d off = node.bend - node.natural, spring = spring_of(node);
    const BendingMemory memory = remember(node);
    return {memory.stored + 0.5 * memory.dissipated, k * solid.stress(off, spring),
            k * solid.stiffness(node.dt) * Eigen::Matrix2d::Identity()};
  }
  BendingMemory remember(const BendingNode& node) const {
    const double k = node.k_b / node.voronoi_length, spring2 = spring_of(node).squaredNorm();
    return {node.natural, k * solid.dissipated(spring2, node.dt),
            k * solid.stored((node.bend - node.natural).squaredNorm(), spring2)};
  }
  void keep_own(const BendingNode& node, double* own) const {
    Eigen::Map<Eigen::Vector2d> dashpot(own);
    dashpot = node.bend - node.natural - spring_of(node);
  }

  void state(Archive& archive) { archive(solid.share, solid.time); }

 private:
  Eigen::Vector2d spring_of(const BendingNode& node) const {
    return solid.spring<Eigen::Vector2d>(node.bend - node.natural, {node.own[0], node.own[1]}, node.dt);
  }
};

}  // namespace knot_utm
