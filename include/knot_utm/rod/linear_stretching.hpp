#pragma once

#include "knot_utm/numeric/law_registry.hpp"
#include "knot_utm/rod/stretching_law.hpp"

namespace knot_utm {

struct RodMaterial;

/// T = k_s (lambda - 1),   W = T^2/(2 k_s).
struct LinearStretching {
  static constexpr const char* kName = "linear";
  static constexpr NoKeys kKeys{};
  static constexpr bool kStudied = true;

  static LinearStretching of(const RodMaterial& /*material*/) { return {}; }

  StretchingResponse respond(const StretchedEdge& edge) const {
    const double tension = edge.k_s * (edge.stretch - 1.0);
    return {0.5 * tension * tension * edge.rest_length / edge.k_s, tension, edge.k_s};
  }

  double strain(double k_s, double tension) const { return tension / k_s; }
};

}  // namespace knot_utm
