#pragma once

#include "knot_utm/method/method.hpp"

/// The values that `auto` stands for in a method. They are the lengths and speeds of the source paper's test, whose
/// rods have a radius of 3.175 mm, scaled with the radius of the rod. A default therefore suits a thread as well as a
/// hawser. Values that the method sets have precedence: where two values must go together and only one is set, the
/// default of the other one is adapted to it.
namespace knot_utm::fields {

struct Defaults {
  SpecimenOptions specimen;
  MachineOptions machine;       ///< its load cell has a suitable capacity and no name
  double scale = 1.0;           ///< radius of the rod over that of the paper's rods; speeds are scaled by it, too [-]
  double way = 0.0;             ///< extension of a pull whose `until.extension` is auto [m]
  double slip_tolerance = 0.0;  ///< slip tolerance of a friction law that creeps [m/s]
};

/// The defaults for a knot of this material. `known`: the method as it was read with the defaults of knot and material
/// alone; null while it has not been read.
Defaults defaults(const SpecimenOptions& specimen, const Material& material, const Method* known);

}  // namespace knot_utm::fields
