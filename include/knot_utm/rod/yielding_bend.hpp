#pragma once

#include "knot_utm/rod/bending_law.hpp"

namespace knot_utm {

/// Two bending springs side by side at one node. One stays elastic, the other slides once it bears its yield moment, in
/// whatever direction the rod bends. With k and k_y their stiffnesses, y the bend at which the second one slides, its
/// elastic bend xi = kappa - kappabar_n and n = xi/|xi|,
///
///   |xi| <= y   M = k kappa + k_y xi     kappabar = kappabar_n
///   |xi| >  y   M = k kappa + k_y y n    kappabar = kappabar_n + (|xi| - y) n
///
/// In the latter case the step dissipates k_y y (|xi| - y) [J], and the tangent is k + k_y y/|xi| (1 - n n^T).
///
/// This tangent has no stiffness k_y along n. Where the second spring holds at the solution, tangents therefore jump
/// from one side on which it slides to the other. Once the direction n has turned away from that of the last trial, the
/// linear model is that of a spring that holds, k_y xi, and the next trial lies where it does, or on the right side.
///
/// Source: Prager 1956 (kinematic hardening); Simo, Hughes 1998, section 1.6.
struct YieldingBend {
  double elastic;   ///< k [N m]
  double yielding;  ///< k_y [N m]
  double yield;     ///< y [-]

  BendingResponse respond(const BendingNode& node) const {
    const Eigen::Vector2d off = node.bend - node.natural;
    const double size = off.norm();
    BendingResponse out;
    out.energy = 0.5 * elastic * node.bend.squaredNorm();
    out.moment = elastic * node.bend;
    out.tangent = elastic * Eigen::Matrix2d::Identity();
    if (size <= yield) {
      out.energy += 0.5 * yielding * size * size;
      out.moment += yielding * off;
      out.tangent += yielding * Eigen::Matrix2d::Identity();
      return out;
    }
    const Eigen::Vector2d direction = off / size;
    out.energy += yielding * yield * (size - 0.5 * yield);
    out.moment += yielding * yield * direction;
    if (has_turned(node.before, direction)) {
      out.beyond = yielding * (size - yield) * direction;
      out.tangent += yielding * Eigen::Matrix2d::Identity();
      return out;
    }
    out.tangent += (yielding * yield / size) * (Eigen::Matrix2d::Identity() - direction * direction.transpose());
    return out;
  }

  BendingMemory remember(const BendingNode& node) const {
    const Eigen::Vector2d off = node.bend - node.natural;
    const double size = off.norm();
    const double energy = respond(node).energy;  // W: what is stored and what is dissipated
    if (size <= yield) return {node.natural, 0.0, energy};
    const double dissipated = yielding * yield * (size - yield);
    return {node.natural + (1.0 - yield / size) * off, dissipated, energy - dissipated};
  }

 private:
  /// Whether the last trial pointed elsewhere. False where there was none.
  static bool has_turned(const Eigen::Vector2d& before, const Eigen::Vector2d& direction) {
    constexpr double kLeastCosine = 0.8;
    return before.dot(direction) < kLeastCosine * before.norm();
  }
};

}  // namespace knot_utm
