#pragma once

#include <array>

#include "knot_utm/numeric/law_registry.hpp"
#include "knot_utm/rod/material.hpp"
#include "knot_utm/rod/yielding_bend.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {

/// Elastic-plastic bending with linear kinematic hardening (yielding_bend.hpp): the fraction r of the bending stiffness
/// stays elastic, and the fraction 1 - r yields,
///
///   k = r k_b/lbar,   k_y = (1 - r) k_b/lbar,   y = kappa_y lbar.
///
/// A rod that is bent for the first time thus yields at the curvature kappa_y, under the moment k_b kappa_y. Without
/// hardening a bend would gather at a single node and depend on the length of the edges. A rod that is bent to a
/// curvature kappa and released keeps kappa - M/k_b.
struct PlasticBending {
  static constexpr const char* kName = "plastic";
  static constexpr LawKey kHardening{
      "hardening", 0.01, 1.0, "-", LawDefault::kPlain, 0.1, "share of stiffness that does not yield; experimental"};
  static constexpr std::array kKeys{kHardening};
  static constexpr bool kStudied = false;
  static constexpr bool kRemembers = true;
  static constexpr int kOwn = 0;

  double yield_curvature = 0.0;  ///< kappa_y, more than 0 [1/m]
  double hardening = 0.0;        ///< r, 0 to 1 [-]

  PlasticBending() = default;
  PlasticBending(double kappa_y, double r) : yield_curvature(kappa_y), hardening(r) {}
  static PlasticBending of(const RodMaterial& material) {
    if (!material.yield_strain)
      throw InvalidInput::sentence(
          "material.yield_strain",
          "material.yield_strain is missing: give the strain of the outermost fibre at which the "
          "rod yields, which bending_law: plastic needs");
    return {*material.yield_strain / material.radius, material.bending.number(kHardening)};
  }

  BendingResponse respond(const BendingNode& node) const { return at(node).respond(node); }
  BendingMemory remember(const BendingNode& node) const { return at(node).remember(node); }

 private:
  YieldingBend at(const BendingNode& node) const {
    const double whole = node.k_b / node.voronoi_length, elastic = hardening * whole;
    return {elastic, whole - elastic, yield_curvature * node.voronoi_length};
  }
};

}  // namespace knot_utm
