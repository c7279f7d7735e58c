#pragma once

#include "knot_utm/machine/options.hpp"
#include "knot_utm/machine/program.hpp"
#include "knot_utm/rod/material.hpp"
#include "knot_utm/sim/options.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

/// A whole test, everything resolved: what a method file says.
struct Method {
  SpecimenOptions specimen;
  Material material;
  MachineOptions machine;
  Program program;
  PhysicsOptions physics;
};

}  // namespace knot_utm
