#pragma once

#include <optional>
#include <vector>

namespace knot_utm {

struct Sample;

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

}  // namespace knot_utm
