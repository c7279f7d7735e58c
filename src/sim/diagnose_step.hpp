#pragma once

#include <functional>
#include <initializer_list>
#include <vector>

#include "knot_utm/contact/contact_point.hpp"
#include "knot_utm/sim/step_diagnosis.hpp"
#include "knot_utm/sim/step_readings.hpp"

namespace knot_utm {

using ContactLists = std::initializer_list<std::reference_wrapper<const std::vector<ContactPoint>>>;

/// A node of a step as Newton's method left it; `residual`: its own [N].
StepDiagnosis diagnose(const RodProperties& rod, const SolvedStep& step, int node, double residual,
                       ContactLists contacts);

}  // namespace knot_utm
