#pragma once

#include "diagnose_step.hpp"
#include "knot_utm/contact/tunnelling.hpp"
#include "knot_utm/sim/time_step.hpp"

namespace knot_utm {

/// What a step that Newton's method solved would do to the rod, and why it may not, where it goes too far. `out`: its
/// largest motion, slip and overlap, and the reason.
void examine(const RodProperties& rod, const StepSettings& settings, const SolvedStep& step,
             const ContactLists& contacts, TunnellingSearch& tunnelling, StepSummary& out);

}  // namespace knot_utm
