#pragma once

#include "knot_utm/io/method.hpp"

/// What `auto` stands for in a method: every length and speed of the source paper's test, whose rods have a radius of
/// 3.175 mm, grows with the radius of the rod. A default therefore suits a thread as it suits a hawser. What a method
/// sets counts: where two values must go together and only one is set, the other one makes room for it.
namespace knot_utm::fields {

struct Defaults {
  SpecimenOptions specimen;
  MachineOptions machine;       ///< its load cell has the capacity that suits, and no name
  double scale = 1.0;           ///< the rod's radius over that of the paper's rods; of speeds, too
  double way = 0.0;             ///< of a pull whose `until.extension` is auto [m]
  double slip_tolerance = 0.0;  ///< of friction that creeps [m/s]
  double drop_extension = 0.0;  ///< of a `drop` [m]
};

/// The defaults for a knot of this material. `known`: the method as it was read with the defaults of the knot and the
/// material alone; null while it has not been read.
Defaults defaults(KnotKind kind, const Material& material, const Method* known);

}  // namespace knot_utm::fields
