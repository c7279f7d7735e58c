#pragma once

#include "knot_utm/rod/bending_laws.hpp"
#include "knot_utm/rod/stretching_laws.hpp"

namespace knot_utm {

/// The laws of one rod, with their parameters. What they remember is in RodState.
struct RodLaws {
  StretchingLaws stretching;  ///< of its edges
  BendingLaws bending;        ///< of its inner nodes; without a natural curvature in the state the elastic one
                              ///< (isotropic_bending.hpp), which is all that require_fits allows there

  /// Those that a material names.
  static RodLaws of(const RodMaterial& material) { return {stretching_law_of(material), bending_law_of(material)}; }
};

/// Whether the laws of two ropes go by the same names. Their parameters may differ.
inline bool of_one_kind(const RodLaws& a, const RodLaws& b) {
  return a.stretching.index() == b.stretching.index() && a.bending.index() == b.bending.index();
}

}  // namespace knot_utm
