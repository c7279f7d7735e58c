#pragma once

#include <algorithm>
#include <array>

#include "knot_utm/numeric/law_registry.hpp"
#include "knot_utm/rod/material.hpp"
#include "knot_utm/rod/yielding_bend.hpp"

namespace knot_utm {

/// Bending of a section whose fibres rub against each other, as those of a rope do. Beside the elastic moment there is
/// one of friction, which grows s - 1 times as fast until the fibres slide, and then keeps its size
/// (yielding_bend.hpp):
///
///   M = k_b kappa + M_f,   |M_f| <= M_y = k_b (m_0/h + c_m h T_max/k_b),   dM_f = (s - 1) k_b dkappa below it.
///
///   s      stick ratio: bending stiffness while no fibre slides, over k_b       [-]
///   m_0    friction moment of a rope that was never pulled, in units of k_b/h   [-]
///   c_m    compaction: what tension adds to the friction moment for good        [-]
///   T_max  the largest tension that has compacted this place of the rod, the law's own number; it changes between
///          two steps only                                                       [N]
///
/// Fibres need a time to come closer, dT_max/dt = (T - T_max)/tau where T is the larger, tau = 0.05 s. A tension that
/// lasts counts whole, while the jerk of a tenth of a millisecond with which a drawn shape springs to rest, or of a
/// snap, whose size is that of the mesh, does not.
///
/// A rod that is bent far, and let go, keeps the curvature M_y/k_b. Textile testers call 2 M_y the
/// hysteresis of bending. Source: the law of Grosberg 1966 for fabrics; compaction is our own.
struct FrictionalBending {
  static constexpr const char* kName = "frictional";
  static constexpr LawKey kStickRatio{
      "stick_ratio", 1.01, 1e3, "-", LawDefault::kPlain, 20.0, "stiffness of a bend before fibres slide"};
  static constexpr LawKey kFrictionMoment{
      "friction_moment", 0.0, 1.0, "k_b/h", LawDefault::kNone, LawKey::kNoValue, "friction moment of a bent rope"};
  static constexpr LawKey kCompaction{
      "compaction", 0.0, 1.0, "-", LawDefault::kPlain, 0.0, "friction moment by tension borne; over the radius"};
  static constexpr std::array kKeys{kStickRatio, kFrictionMoment, kCompaction};
  static constexpr bool kStudied = true;
  static constexpr bool kRemembers = true;
  static constexpr int kOwn = 1;
  static constexpr double kCompactionTime = 0.05;  ///< tau [s]

  double stick_ratio = 1.0;  ///< s [-]
  double curvature = 0.0;    ///< m_0/h: M_y/k_b of a rope that was never pulled [1/m]
  double by_tension = 0.0;   ///< c_m h/k_b: what T_max adds to it [1/(m N)]

  static FrictionalBending of(const RodMaterial& material) {
    FrictionalBending out;
    out.stick_ratio = material.bending.number(kStickRatio);
    out.curvature = material.bending.number(kFrictionMoment) / material.radius;
    out.by_tension = material.bending.number(kCompaction) * material.radius / material.bending_stiffness;
    return out;
  }

  BendingResponse respond(const BendingNode& node) const { return at(node).respond(node); }
  BendingMemory remember(const BendingNode& node) const { return at(node).remember(node); }
  void keep_own(const BendingNode& node, double* own) const {
    own[0] = node.own[0] + std::max(node.tension - node.own[0], 0.0) * (node.dt / (node.dt + kCompactionTime));
  }

 private:
  YieldingBend at(const BendingNode& node) const {
    const double elastic = node.k_b / node.voronoi_length, sticks = stick_ratio - 1.0;
    return {elastic, sticks * elastic, (curvature + by_tension * node.own[0]) * node.voronoi_length / sticks};
  }
};

}  // namespace knot_utm
