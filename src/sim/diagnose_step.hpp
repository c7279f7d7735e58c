#pragma once

#include <array>
#include <functional>
#include <vector>

#include "knot_utm/contact/contact_point.hpp"
#include "knot_utm/contact/tunnelling.hpp"
#include "knot_utm/sim/step_account.hpp"
#include "knot_utm/sim/time_step.hpp"

namespace knot_utm {

struct RodProperties;

/// The lists of contacts between strands and on rollers.
using ContactLists = std::array<std::reference_wrapper<const std::vector<ContactPoint>>, 2>;

/// Diagnoses one node of a step in the state in which Newton's method ended. `residual`: that of the node [N].
StepDiagnosis diagnose(const RodProperties& rod, const SolvedStep& step, int node, double residual,
                       const ContactLists& contacts);

/// Checks whether a step that Newton's method solved may be accepted. Writes to `out` its largest motion, slip and
/// overlap, and the reason where it may not be accepted: a node moves too far, strands overlap too much, or strands
/// would pass through each other.
void examine(const RodProperties& rod, const StepSettings& settings, const SolvedStep& step,
             const ContactLists& contacts, TunnellingSearch& tunnelling, StepSummary& out);

}  // namespace knot_utm
