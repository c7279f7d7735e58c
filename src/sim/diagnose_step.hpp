#pragma once

#include <array>
#include <functional>
#include <vector>

#include "knot_utm/contact/contact_point.hpp"
#include "knot_utm/sim/solved_step.hpp"
#include "knot_utm/sim/step_diagnosis.hpp"

namespace knot_utm {

/// Contacts between strands, and on rollers.
using ContactLists = std::array<std::reference_wrapper<const std::vector<ContactPoint>>, 2>;

/// A node of a step as Newton's method left it; `residual`: its own [N].
StepDiagnosis diagnose(const RodProperties& rod, const SolvedStep& step, int node, double residual,
                       const ContactLists& contacts);

}  // namespace knot_utm
