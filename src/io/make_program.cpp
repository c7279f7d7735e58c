// The program of a method, with the limits at which the machine ends a test.
#include <algorithm>

#include "knot_utm/io/method.hpp"
#include "method_fields.hpp"

namespace knot_utm {
namespace {

/// From which load on a fall may be a break, unless the method says so: testing machines have such a fraction.
constexpr double kArmingFraction = 0.02;  // of the cell's capacity

/// Half the windows within which a drop of the load counts as a break, so that they are resolved [s].
double longest_period(const Method& method) {
  const BreakDetection& breaks = method.ends.breaks;
  double window = fields::kInfinity;
  if (breaks.sharp_drop) window = breaks.sharp_drop_time;
  if (breaks.drop)
    for (const ProgramStep& step : method.program) window = std::min(window, breaks.drop_extension / step.speed);
  return 0.5 * window;
}

}  // namespace

ProgramRunner make_program(const Method& method, double longest_step) {
  ProgramRunner::Limits limits;
  const double capacity = method.machine.load_cell.capacity;
  const MachineOptions& machine = method.machine;
  const double h = method.material.radius;
  limits.load = method.ends.load.value_or(capacity);
  limits.least_distance = (machine.grips == GripKind::kRollers ? machine.roller_diameter : 0.0) + 2.0 * h;
  limits.travel = method.machine.travel;
  limits.time = method.ends.time.value_or(limits.time);
  limits.breaks = method.ends.breaks;
  limits.breaks.arming_load = method.ends.arming_load.value_or(kArmingFraction * capacity);
  return ProgramRunner(method.program, machine.load_cell.sampling_rate, std::min(longest_step, longest_period(method)),
                       limits);
}

}  // namespace knot_utm
