#pragma once

#include <functional>

#include "knot_utm/analysis/margin.hpp"
#include "knot_utm/machine/options.hpp"
#include "knot_utm/record/program.hpp"
#include "knot_utm/rod/material.hpp"
#include "knot_utm/sim/options.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

/// The test whose knot is looked at.
struct MarginTest {
  SpecimenOptions specimen;
  Material material;
  MachineOptions machine;
  PhysicsOptions physics;
  Program program;
};

/// Runs short tests one after the other, of accuracy `draft`: each ties, mounts and pulls the specimen until a fifth of
/// the knot distance is passed, which is behind breakaway. The knot opens in a test in which it comes undone or jumps
/// open (curve_readings.hpp). The same test gives the same margin, to the bit. `interrupted()` is asked between
/// commands.
Margin find_margin(const MarginTest& test, const std::function<bool()>& interrupted);

}  // namespace knot_utm
