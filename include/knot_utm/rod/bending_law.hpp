#pragma once

#include <Eigen/Core>

namespace knot_utm {

/// The interface of a bending law. At every inner node a law gives the bending moment as a function of the bend and of
/// an internal variable, the natural curvature kappabar_n of the last accepted step,
///
///     M = dW/dkappa,   W(kappa; kappabar_n) = E(kappa, kappabar) + D(kappabar - kappabar_n),
///
/// kappabar being the natural curvature that is kept once this step is accepted, and D the energy dissipated in this
/// step, however long it is. W is the incremental energy of the variational form. Where nothing is dissipated, it is
/// the elastic energy E.
///
/// A law is a header and one line in `BendingLaws` (bending_laws.hpp). It is a plain struct, which has
///
///     static constexpr const char* kName          the name that methods use (material.bending_law)
///     static Law of(Material)                     made from a method; throws InvalidInput where a value is missing
///     static constexpr std::array kKeys           its keys in `material` (LawKey), or NoKeys
///     static constexpr bool kStudied              whether the errors beside readings were studied with this law
///                                                 (settings/accuracy.hpp)
///     static constexpr bool kRemembers            whether its internal variable changes in a step
///     static constexpr int kOwn                   how many numbers besides it the law remembers of every node
///     respond(BendingNode)                        -> BendingResponse
///     remember(BendingNode)                       -> BendingMemory, once the step is accepted
///     keep_own(BendingNode, double* own)          changes its own numbers, once the step is accepted; only where kOwn
///                                                 is more than 0
///
/// The state of the rod has room for the numbers of its law, archives them and hands them to it node by node; a law
/// needs no other code for its memory. They are zero at first, do not change within a step, and so leave the moment a
/// function of the bend alone. An evaluation of the rod chooses the law once (std::visit), not at every node.
/// Source: Simo, Hughes 1998, chapter 1 (return mapping); Ortiz, Stainier 1999 (its variational form).

/// What a law is told of one inner node. Curvatures are integrated over the Voronoi length, on (m1, m2).
struct BendingNode {
  double k_b;                   ///< stiffness [N m^2]
  double voronoi_length;        ///< lbar [m]
  Eigen::Vector2d bend;         ///< kappa [-]
  Eigen::Vector2d natural;      ///< kappabar_n, of the last accepted step [-]
  double dt = 0.0;              ///< length of this step, for keep_own only [s]
  const double* own = nullptr;  ///< the law's kOwn numbers, of the last accepted step
  double tension = 0.0;         ///< mean of the node's two edges once the step is accepted, for keep_own only [N]
  /// kappa - kappabar_n of the trial before this one in the same step [-]; zero: there was none.
  Eigen::Vector2d before = Eigen::Vector2d::Zero();
};

/// Newton's method solves with the linear model moment + beyond + tangent (kappa' - kappa). It is the law's tangent
/// where `beyond` is zero. A law that yields may choose the model of a branch that its trials have jumped over.
struct BendingResponse {
  double energy;                                     ///< W [J]
  Eigen::Vector2d moment;                            ///< dW/dkappa [N m]
  Eigen::Matrix2d tangent;                           ///< d2W/dkappa2, symmetric; where `beyond` is zero [N m]
  Eigen::Vector2d beyond = Eigen::Vector2d::Zero();  ///< moment of the linear model less `moment` [N m]
};

/// What a law keeps of an accepted step.
struct BendingMemory {
  Eigen::Vector2d natural;  ///< kappabar [-]
  double dissipated;        ///< in this step, at least 0 [J]
  double stored;            ///< E(kappa, kappabar) [J]
};

}  // namespace knot_utm
