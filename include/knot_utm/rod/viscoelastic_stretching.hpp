#pragma once

#include <array>
#include <limits>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/law_keys.hpp"
#include "knot_utm/rod/material.hpp"
#include "knot_utm/rod/standard_solid.hpp"
#include "knot_utm/rod/stretching_law.hpp"

namespace knot_utm {

/// T = k_s (lambda - 1) of an edge that is stretched fast, of which a share relaxes while the stretch is held
/// (standard_solid.hpp). A held load falls to 1 - s of itself, and under a constant load a rod creeps to 1/(1 - s) of
/// its first strain with the time tau/(1 - s).
struct ViscoelasticStretching {
  static constexpr const char* kName = "viscoelastic";
  static constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
  static constexpr LawKey kShare{"relaxation_share", 0.0, 0.99, "-", LawDefault::kNone, kNoValue};
  static constexpr LawKey kTime{"relaxation_time", 1e-3, 1e9, "s", LawDefault::kNone, kNoValue};
  static constexpr std::array kKeys{kShare, kTime};
  static constexpr bool kStudied = false;
  static constexpr bool kRemembers = true;

  StandardSolid solid;

  static ViscoelasticStretching of(const RodMaterial& material) {
    return {{material.stretching.number(kShare), material.stretching.number(kTime)}};
  }

  StretchingResponse respond(const StretchedEdge& edge) const {
    const StretchingMemory memory = remember(edge);
    return {memory.stored + 0.5 * memory.dissipated,
            edge.k_s * solid.stress(edge.stretch - 1.0, edge.stretch - 1.0 - memory.own),
            edge.k_s * solid.stiffness(edge.dt)};
  }
  StretchingMemory remember(const StretchedEdge& edge) const {
    const double strain = edge.stretch - 1.0, spring = solid.spring(strain, edge.own, edge.dt);
    const double scale = edge.k_s * edge.rest_length;
    return {strain - spring, scale * solid.dissipated(spring * spring, edge.dt),
            scale * solid.stored(strain * strain, spring * spring)};
  }

  /// When it is stretched at once.
  double strain(double k_s, double tension) const { return tension / k_s; }

  void state(Archive& archive) { archive(solid.share, solid.time); }
};

}  // namespace knot_utm
