#pragma once

#include <Eigen/Core>

namespace knot_utm {

/// The face of a bending law. At every inner node a law says which moment the rod's bend needs, as a function of the
/// bend and of what the law remembers of the steps before,
///
///     M = dW/dkappa,   W(kappa; kappabar_n) = E(kappa, kappabar) + (energy dissipated in this step),
///
/// kappabar being what it will remember once the step is accepted. W is that of the incremental variational form: where
/// nothing is dissipated, it is the elastic energy E.
///
/// A law is a pair of files, or a header, and one line in `BendingLaws` (bending_laws.hpp). It is a plain struct, which
///
///     static constexpr const char* kName          is what a method calls it (material.bending_law)
///     static Law of(Material)                     from a method; throws InvalidInput where a value is missing
///     static constexpr bool kRemembers            whether what it remembers changes in a step; the rod then needs
///                                                 frames and RodState::natural_curvature, be it zero
///     respond(BendingNode) -> BendingResponse
///     remember(BendingNode) -> BendingMemory      once the step is accepted
///     state(Archive&)                             its parameters
///
/// A whole rod is visited once per evaluation (std::visit), so that no node pays for the choice.
/// Source: Simo, Hughes 1998, chapter 1 (return mapping); Ortiz, Stainier 1999 (its variational form).

/// What a law is told of one inner node. Curvatures are integrated over the Voronoi length, on (m1, m2).
struct BendingNode {
  double stiffness;         ///< k_b [N m^2]
  double voronoi_length;    ///< lbar [m]
  Eigen::Vector2d bend;     ///< kappa [-]
  Eigen::Vector2d natural;  ///< kappabar_n, as it was remembered [-]
};

struct BendingResponse {
  double energy;            ///< W [J]
  Eigen::Vector2d moment;   ///< dW/dkappa [N m]
  Eigen::Matrix2d tangent;  ///< d2W/dkappa2, symmetric [N m]
};

/// What a law keeps of an accepted step.
struct BendingMemory {
  Eigen::Vector2d natural;  ///< kappabar [-]
  double dissipated;        ///< in this step, at least 0 [J]
};

}  // namespace knot_utm
