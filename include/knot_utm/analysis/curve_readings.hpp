#pragma once

#include <optional>
#include <vector>

#include "knot_utm/machine/sample.hpp"

namespace knot_utm {

/// One reading of a pull. The samples of a pull that count are those that reach a new largest extension.
struct PullPoint {
  double time;                           ///< [s]
  double extension;                      ///< s [m]
  double knot_distance = Sample::kNone;  ///< e [m]
  double force = 0.0;                    ///< F on the upper grip [N]
  double normal_force = Sample::kNone;   ///< sum over all contacts of strands [N]
};
using Pull = std::vector<PullPoint>;

double peak_force(const Pull& pull);  ///< largest F of a pull that has a point [N]

/// From one extension to another [m].
struct Range {
  double low, high;
};

/// Of a pull that slides up to s = `end`, from 0.3 to 0.8 of the way: the breakaway lies before, the onset of locking
/// behind.
Range plateau_range(const Pull& pull, double end);

/// Means over that range, by the trapezoidal rule.
struct Plateau {
  double force = 0.0;     ///< F [N]
  double force_sd = 0.0;  ///< its standard deviation [N]
  double slope = 0.0;     ///< de/ds [-]; NaN where e is not known
  double rise = 0.0;      ///< of F over the range, by the means of its halves [N]
};

/// None where the range is empty.
std::optional<Plateau> plateau(const Pull& pull, double end);

/// Largest F before the plateau of a pull that slides up to s = `end` [N]; at least 0.
double breakaway_force(const Pull& pull, double end);

/// Slope of F(s) where the rod carries the load: over the points from s = `from` on, up to the peak, whose F lies
/// between half the peak and the peak, at least the last three. The middle one of the least-squares slopes in three
/// parts of equal extension: strands that slip inside a locked knot let F fall at one place. [N/m]
std::optional<double> locked_stiffness(const Pull& pull, double from);

/// What a force-extension curve says by itself, be it measured or simulated. A test's own, those of its load cell, are
/// in result.yaml by the same names and to the last digit.
struct CurveReadings {
  std::optional<double> peak_force;  ///< [N]
  std::optional<double>
      plateau_force;  ///< mean F before the lock; without one where F is level: it rises by less than half [N]
  std::optional<double> plateau_force_sd;        ///< [N]
  std::optional<double> breakaway_force;         ///< largest F before the plateau, where there is one [N]
  std::optional<double> lock_extension_by_load;  ///< s_l [m]
  std::optional<double> locked_stiffness;        ///< behind s_l; of the whole pull where there is no plateau [N/m]
};

/// The lock by the load alone is where F last rises through twice the mean of its plateau, which the lock itself
/// bounds: s_l is the fixed point that is reached from the peak. A load in proportion to s has none, and none counts
/// that lies in the first 15 % of the pull. In simulations of the shipped materials that lock, it lies 1 to 5 % of s_l
/// behind the one that the knots tell (`Results::lock_extension`): F doubles after they have begun to hold.
CurveReadings curve_readings(const Pull& pull);

}  // namespace knot_utm
