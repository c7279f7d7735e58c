#pragma once

#include <array>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/law_keys.hpp"
#include "knot_utm/rod/bending_law.hpp"

namespace knot_utm {

struct RodMaterial;

/// Elastic-plastic bending with linear kinematic hardening: two springs in parallel. One has the fraction r of the
/// bending stiffness and stays elastic. The other has the fraction 1 - r and bears at most its yield moment, in
/// whatever direction the rod bends. With the latter's elastic bend xi = kappa - kappabar_n, its direction n = xi/|xi|,
/// k = k_b/lbar, and the bend at yield y = kappa_y lbar,
///
///   |xi| <= y   M = r k kappa + (1 - r) k xi     kappabar = kappabar_n
///   |xi| >  y   M = r k kappa + (1 - r) k y n    kappabar = kappabar_n + (|xi| - y) n
///
/// and in the latter case the step dissipates (1 - r) k y (|xi| - y) [J]. A rod that is bent for the first time thus
/// yields at the curvature kappa_y, under the moment k_b kappa_y. Beyond, its tangent is r k + (1 - r) k y/|xi| (1 - n
/// n^T). Without hardening a bend would gather at a single node and depend on the length of the edges. A rod that is
/// bent to a curvature kappa and released keeps kappa - M/k_b. Source: Prager 1956 (kinematic hardening); Simo, Hughes
/// 1998, section 1.6.
struct PlasticBending {
  static constexpr const char* kName = "plastic";
  static constexpr LawKey kHardening{"hardening", 0.01, 1.0, "-", LawDefault::kPlain, 0.1};
  static constexpr std::array kKeys{kHardening};
  static constexpr bool kStudied = false;
  static constexpr bool kRemembers = true;

  double yield_curvature = 0.0;  ///< kappa_y, more than 0 [1/m]
  double hardening = 0.0;        ///< r, 0 to 1 [-]

  PlasticBending() = default;
  PlasticBending(double kappa_y, double r) : yield_curvature(kappa_y), hardening(r) {}
  static PlasticBending of(const RodMaterial& material);

  BendingResponse respond(const BendingNode& node) const {
    const double whole = node.k_b / node.voronoi_length, stiff = hardening * whole, yields = whole - stiff;
    const double yield = yield_curvature * node.voronoi_length;
    const Eigen::Vector2d off = node.bend - node.natural;
    const double size = off.norm();
    BendingResponse out;
    out.energy = 0.5 * stiff * node.bend.squaredNorm();
    out.moment = stiff * node.bend;
    out.tangent = stiff * Eigen::Matrix2d::Identity();
    if (size <= yield) {
      out.energy += 0.5 * yields * size * size;
      out.moment += yields * off;
      out.tangent += yields * Eigen::Matrix2d::Identity();
      return out;
    }
    const Eigen::Vector2d direction = off / size;
    out.energy += yields * yield * (size - 0.5 * yield);
    out.moment += yields * yield * direction;
    out.tangent += (yields * yield / size) * (Eigen::Matrix2d::Identity() - direction * direction.transpose());
    return out;
  }

  BendingMemory remember(const BendingNode& node) const {
    const double yields = (1.0 - hardening) * node.k_b / node.voronoi_length;
    const double yield = yield_curvature * node.voronoi_length;
    const Eigen::Vector2d off = node.bend - node.natural;
    const double size = off.norm();
    const double energy = respond(node).energy;  // W: what is stored and what is dissipated
    if (size <= yield) return {node.natural, 0.0, energy};
    const double dissipated = yields * yield * (size - yield);
    return {node.natural + (1.0 - yield / size) * off, dissipated, energy - dissipated};
  }

  void state(Archive& archive) { archive(yield_curvature, hardening); }
};

}  // namespace knot_utm
