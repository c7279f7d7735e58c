#pragma once

#include <functional>
#include <initializer_list>
#include <vector>

#include "knot_utm/contact/contact_point.hpp"
#include "knot_utm/sim/step_diagnosis.hpp"
#include "knot_utm/sim/step_readings.hpp"

namespace knot_utm {

using ContactLists = std::initializer_list<std::reference_wrapper<const std::vector<ContactPoint>>>;

/// Where a step was hardest, as Newton's method left it.
StepDiagnosis diagnose(const RodProperties& rod, const SolvedStep& step, bool converged, ContactLists contacts);

}  // namespace knot_utm
