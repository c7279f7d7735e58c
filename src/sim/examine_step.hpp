#pragma once

#include "diagnose_step.hpp"
#include "knot_utm/contact/tunnelling.hpp"
#include "knot_utm/sim/time_step.hpp"

namespace knot_utm {

/// Checks whether a step that Newton's method solved may be accepted. Writes to `out` its largest motion, slip and
/// overlap, and the reason where it may not be accepted: a node moves too far, strands overlap too much, or strands
/// would pass through each other.
void examine(const RodProperties& rod, const StepSettings& settings, const SolvedStep& step,
             const ContactLists& contacts, TunnellingSearch& tunnelling, StepSummary& out);

}  // namespace knot_utm
