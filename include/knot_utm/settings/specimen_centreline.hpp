#pragma once

#include "knot_utm/sim/options.hpp"
#include "knot_utm/specimen/centreline.hpp"
#include "knot_utm/specimen/machine_options.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

struct Material;

/// The rod's centreline in the machine before anything moves, with the lower grip at the origin, pulled along +z, and
/// with the edges of the chosen accuracy. Throws InvalidInput where the specimen does not fit the machine.
Centreline specimen_centreline(const SpecimenOptions& specimen, const Material& material, const MachineOptions& machine,
                               const PhysicsOptions& physics);

/// Length of rod beyond the distance of its two ends, of a knotted strand that is pulled as it was drawn; 0 of all
/// other specimens [m].
double slack_of(const SpecimenOptions& specimen, const Centreline& centreline);

}  // namespace knot_utm
