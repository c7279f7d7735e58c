#pragma once

#include <functional>

#include "knot_utm/analysis/margin.hpp"
#include "knot_utm/machine/options.hpp"
#include "knot_utm/record/program.hpp"
#include "knot_utm/sim/options.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

/// The test whose knot is examined.
struct MarginTest {
  SpecimenOptions specimen;
  Material material;
  MachineOptions machine;
  PhysicsOptions physics;
  Program program;
};

/// Finds the safety margin of a knot by short tests with accuracy `draft`, one after the other. Each test ties and
/// mounts the specimen, and pulls it by a fifth of the knot distance, which is beyond breakaway. The knot opens in a
/// test if it comes undone or jumps open (curve_readings.hpp). The same test gives the same margin, to the last bit.
/// `interrupted()` is called between commands and says whether to stop.
Margin find_margin(const MarginTest& test, const std::function<bool()>& interrupted);

}  // namespace knot_utm
