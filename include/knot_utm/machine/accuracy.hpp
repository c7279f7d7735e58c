#pragma once

#include <optional>

#include "knot_utm/rod/material.hpp"
#include "knot_utm/sim/options.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

/// What an accuracy stands for, with every tolerance that the method sets beside it.
struct Tolerances {
  double longest_step;       ///< [s]
  double residual;           ///< [k_b/h^2]
  double contact_tolerance;  ///< delta [h]
  double presliding;         ///< xi_s [h]
  double refinement;         ///< edges in knots are shorter by this factor [-]
};

/// A rod with k_s h^2/k_b < 10 (a solid one has 4) that is tied to a fisherman's loop stretches where a rope slides.
/// Its readings are those of the stretching, which looser contacts and coarser knots move by less than a per cent.
Tolerances tolerances(const PhysicsOptions& physics, const SpecimenOptions& specimen, const Material& material);

/// The estimated numerical errors of readings, as fractions of them. Empty where no convergence study covers the case.
struct ReadingErrors {
  std::optional<double> plateau_force;
  std::optional<double> lock_extension;
  std::optional<double> locked_stiffness;
};

/// With edges of l in the knots, contact tolerance delta, presliding xi_s, longest step dt, residual r, and the
/// pre-load in units of bending, P = F_p h^2/k_b:
///
///     plateau    (0.005 + 0.002 P) (2 l/h)^2 + (0.005 + 0.00175 P) delta/0.02h + 0.01 xi_s/0.002h
///                + 0.005 dt/0.17s + 0.003 r/(1e-4 k_b/h^2)
///     lock       0.004 + 0.006 (2 l/h)^2 + 0.002 dt/0.17s
///     stiffness  0.005 + 0.006 (2 l/h)^2
///
/// The powers are the orders of the method. The factors were chosen after `scripts/bench convergence` (normal and
/// draft, three pre-loads; P of 3 to 53; contact `smooth` and friction `memory`): those of plateau and lock for
/// polypropylene and nylon, that of the stiffness for VPS too. doc/performance.md says how they held for loops they
/// were not chosen for. For nylon the plateau's is large: the effects of edges and contact tolerance partly cancel. The
/// 0.1 % for a straight rod, whose stiffness is exact but for the residual, is an upper bound by judgement.
ReadingErrors reading_errors(const SpecimenOptions& specimen, const Material& material, const PhysicsOptions& physics);

}  // namespace knot_utm
