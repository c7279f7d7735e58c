#pragma once

#include <cmath>
#include <optional>
#include <vector>

/// Readings of a pull that need every time step, and not only those of the load cell.
namespace knot_utm {

struct Sample;

/// Energy stored in the rod and its contacts [J].
double stored_energy(const Sample& sample);

/// How far a pull is from a quasi-static one, whose forces do not depend on time. For each value, the change of an
/// energy in a time step is divided by the change of s in that step, which gives a force. The value is the median of
/// these forces, weighted by the change of s, over the mean of |F|. The energy released as a knot jumps open belongs to
/// little extension, so the median ignores it.
///
/// All accepted time steps of the pull are used, up to the lock. Where there is no lock they are used until the knot
/// comes undone, the rod parts or the pull ends. A value is empty where nothing was pulled or the mean force is zero.
struct RateShares {
  std::optional<double> drag;       ///< from the energy dissipated by drag [-]
  std::optional<double> inertia;    ///< from the change of the kinetic energy [-]
  std::optional<double> numerical;  ///< from the energy that the time integration dissipates or adds [-]
};

/// `samples`: all accepted time steps of the test. `lock_extension` in m, `untangled_at` in s; empty: the knots did not
/// lock, or did not come undone.
RateShares rate_shares(const std::vector<Sample>& samples, std::optional<double> lock_extension,
                       std::optional<double> untangled_at);

/// A rod with one knot or none that snaps from one shape into another while it is pulled, as an overhand that inverts
/// or a stopper that capsizes.
struct Snap {
  double extension;  ///< s at which the force begins to fall [m]
  double drop;       ///< by how much it falls [N]
};

/// The snap of the largest fall of the true force F in a pull; empty where nothing snapped. `samples`: all time steps.
///
/// Between two time steps of a snap, on one way of the crosshead outwards and both at a new largest s,
///   - F falls by a tenth or more;
///   - the rod gives up at least a fiftieth of its stored energy, and twice as much as the grips put in meanwhile;
///   - it still stores as much as when the pull began, so that what it gives up is what the pull had stored. A shape
///     that was sketched and settles as the pull begins does not snap.
/// All of these are ratios, so they hold for any size and stiffness, and do not depend on how long is pulled after it.
/// Strands that stick and slip give up less. A loop of two knots has jumps in place of snaps (curve_readings.hpp).
std::optional<Snap> snap(const std::vector<Sample>& samples);

/// True forces on both grips at one time [N].
struct GripForces {
  double upper, lower;

  double difference() const { return std::abs(upper - lower); }
};

/// The forces on the grips where they differ most, from the sample before the first pull over its first hundredth. At
/// rest both are the same, apart from the rod's weight. They differ while the specimen still moves, and where the pull
/// sets it moving by a jerk. Empty: nothing was pulled.
std::optional<GripForces> forces_at_start(const std::vector<Sample>& samples);

}  // namespace knot_utm
