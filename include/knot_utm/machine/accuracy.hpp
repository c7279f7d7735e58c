#pragma once

#include <optional>

#include "knot_utm/machine/options.hpp"
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
  double refinement;         ///< edges of both strands between and within the knots are shorter by this factor [-]
};

/// A rod with k_s h^2/k_b < 10 (a solid one has 4) that is tied to a fisherman's loop stretches where a rope slides.
/// Its readings are those of the stretching, which looser contacts and coarser knots move by less than a per cent. A
/// rope that is tied with F_p > 6 k_b/h^2 has edges shorter by (F_p h^2/(6 k_b))^(1/4), up to 4/3, but for `draft`.
Tolerances tolerances(const PhysicsOptions& physics, const SpecimenOptions& specimen, const Material& material);

/// The estimated numerical errors of readings, as fractions of them. Empty where no convergence study covers the case.
struct ReadingErrors {
  std::optional<double> plateau_force;
  std::optional<double> lock_extension;
  std::optional<double> locked_stiffness;
};

/// Each is meant to hold 95 % of the differences to a run at `fine` with edges half as long as at `normal`. Its size at
/// `normal` is that found over loops drawn at random (`scripts/bench readings`); it depends on the hands of the knots,
/// on friction, and of rods that stretch on the length of the loop. Other edges and tolerances raise or lower it: edges
/// by their square, contact tolerance, presliding, longest step and residual each by its share.
ReadingErrors reading_errors(const SpecimenOptions& specimen, const Material& material, const MachineOptions& machine,
                             const PhysicsOptions& physics);

/// By how much the error of a plateau is larger since the knots slide under so little force [N] that they are hardly
/// closed [-]: 1 where they are.
double hardly_closed(double plateau_force, const Material& material);

}  // namespace knot_utm
