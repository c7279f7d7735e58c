#pragma once

#include <optional>
#include <vector>

namespace knot_utm {

struct Sample;

/// A rod with one knot or none that snaps from one shape into another while it is pulled, as an overhand that inverts
/// or a stopper that capsizes.
struct Snap {
  double extension;  ///< s at which the force begins to fall [m]
  double drop;       ///< by how much it falls [N]
};

/// The snap of the largest fall of the true force F in a pull; empty where nothing snapped. `samples`: all time steps.
///
/// Between two time steps of a snap
///   - F falls by a tenth or more;
///   - the rod gives up at least a fiftieth of its stored energy, and twice as much as the grips put in meanwhile;
///   - it still stores as much as when the pull began, so that what it gives up is what the pull had stored. A shape
///     that was drawn and settles as the pull begins does not snap.
/// All of these are ratios, so they hold for any size and stiffness, and do not depend on how long is pulled after it.
/// Strands that stick and slip give up less. A loop of two knots has jumps in place of snaps (curve_readings.hpp).
std::optional<Snap> snap(const std::vector<Sample>& samples);

}  // namespace knot_utm
