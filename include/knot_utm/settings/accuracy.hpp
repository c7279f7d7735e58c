#pragma once

#include <optional>

#include "knot_utm/sim/options.hpp"
#include "knot_utm/specimen/machine_options.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

struct Material;

/// The tolerances of an accuracy, or those that the method sets instead.
struct Tolerances {
  double longest_step;       ///< [s]
  double residual;           ///< [k_b/h^2]
  double contact_tolerance;  ///< delta [h]
  double presliding;         ///< xi_s [h]
  double refinement;         ///< edges of both strands between and within the knots are shorter by this factor [-]
};

/// A fisherman's loop of a rod with k_s h^2/k_b < 10 (a solid one has 4) stretches where one of rope slides. Its
/// readings are those of the stretching, which wider tolerances and longer edges change by less than a per cent. A rope
/// that is tied with F_p > 6 k_b/h^2 has edges shorter by (F_p h^2/(6 k_b))^(1/4), up to 4/3, except at `draft`.
Tolerances tolerances(const PhysicsOptions& physics, const SpecimenOptions& specimen, const Material& material);

/// Estimated numerical errors of readings, as fractions of the readings [-]. Empty where no convergence study covers
/// the case.
struct RelativeErrors {
  std::optional<double> plateau_force;
  std::optional<double> lock_extension;
  std::optional<double> locked_stiffness;
  bool rolls = false;  ///< strands roll on each other: then knots that are hardly closed were studied, too
  bool soft = false;   ///< sections give
  std::optional<double> break_in_bend{};  ///< of the load at which a knot parts where its bend helps to part it
  std::optional<double> largest_load{};   ///< of a knot that a file describes
};

/// Each error is meant to contain 95 % of the differences from a run at `fine` with edges half as long, a quarter of
/// the presliding displacement and shorter steps. Its size at `normal` was found over loops drawn at random
/// (`scripts/bench readings`). It depends on the handedness of the knots, on friction and, for rods that stretch, on
/// the length of the loop. The contribution of the edges is proportional to the square of their length, those of
/// contact tolerance, presliding displacement, longest step and residual to their values. Studied were elastic sections
/// with friction on the centrelines, ones whose fibres rub with friction's whole couple, and soft ones of rubber; of
/// knots that files describe, their largest load (bench/results/knots.md), in one material at a time.
RelativeErrors relative_errors(const SpecimenOptions& specimen, const Material& material, const MachineOptions& machine,
                               const PhysicsOptions& physics);

/// Whether knots slide under so small a force [N] that they are hardly closed. What the mesh then does to the readings
/// is known only where strands roll (errors_of_hardly_closed).
bool hardly_closed(double plateau_force, const Material& material);
/// The errors of such knots: larger ones of plateau and lock where strands roll, a smaller one of the plateau where
/// their sections give, and none otherwise.
RelativeErrors errors_of_hardly_closed(const RelativeErrors& errors);

}  // namespace knot_utm
