#include "knot_utm/specimen/machine_options.hpp"

#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

bool rollers_hold(const SpecimenOptions& specimen, const MachineOptions& machine) {
  return knot_of(specimen).about().loop && machine.grips == GripKind::kRollers;
}

bool clamps_hold(const SpecimenOptions& specimen, const MachineOptions& machine) {
  return machine.grips != GripKind::kNodes && !rollers_hold(specimen, machine);
}

bool clamp_turns(const SpecimenOptions& specimen, const MachineOptions& machine) {
  const bool holds_none = specimen.drawing && specimen.drawing->upper.empty();
  return clamps_hold(specimen, machine) && !knot_of(specimen).about().loop && !holds_none;
}

}  // namespace knot_utm
