#pragma once

#include "knot_utm/breaking/breaking_law.hpp"
#include "knot_utm/numeric/law_registry.hpp"
#include "knot_utm/specimen/material.hpp"

namespace knot_utm {

/// A rod parts where its tension T reaches the breaking force F_b, the tension at which it parts straight [N]:
///
///   fraction = T/F_b
///
/// A knot never raises the tension above the load, so that this law predicts nothing of what a knot costs.
struct TensionBreaking {
  static constexpr const char* kName = "tension";
  static constexpr NoKeys kKeys{};
  static constexpr bool kStudied = true;
  static constexpr bool kBends = false;  ///< whether the bend of an edge counts
  static constexpr BreakLimit kLimit = BreakLimit::kForce;

  double breaking_force = 0.0;  ///< F_b [N]

  static TensionBreaking of(const Material& material) { return {*material.breaking_force}; }

  double limited(const LoadedEdge& edge) const { return edge.tension; }
  double fraction(const LoadedEdge& edge) const { return edge.tension / breaking_force; }
  bool crushes() const { return false; }
};

}  // namespace knot_utm
