#pragma once

#include <array>
#include <functional>
#include <vector>

#include "knot_utm/contact/contact_point.hpp"
#include "knot_utm/sim/solved_step.hpp"
#include "knot_utm/sim/step_diagnosis.hpp"

namespace knot_utm {

struct RodProperties;

/// The lists of contacts between strands and on rollers.
using ContactLists = std::array<std::reference_wrapper<const std::vector<ContactPoint>>, 2>;

/// Diagnoses one node of a step in the state in which Newton's method ended. `residual`: that of the node [N].
StepDiagnosis diagnose(const RodProperties& rod, const SolvedStep& step, int node, double residual,
                       const ContactLists& contacts);

}  // namespace knot_utm
