#pragma once

#include <optional>

#include "knot_utm/analysis/curve_readings.hpp"

namespace knot_utm {

/// Readings that a tester takes from a pull of a knot or of a plain rod. The force F is interpolated linearly between
/// the points. Its largest value is F_p, at the extension s_p. The origin, s_0 and F_0, is the first point. Energies
/// are in J and stiffnesses in N/m. A reading is empty where the pull does not have it.

double energy(const Pull& pull);          ///< integral of F over s from the origin to the last point
double energy_to_peak(const Pull& pull);  ///< the same integral, from the origin to s_p

std::optional<double> peak_extension(const Pull& pull);  ///< s_p [m]

/// Mean of F over the second half of the extension. Empty where F is not steady there, that is where its means over the
/// third and the fourth quarter differ by more than 2 %, and where the pull covers no extension.
std::optional<double> steady_force(const Pull& pull);

/// Chord stiffness (F_2 - F_1)/(s_2 - s_1), with F_1 and F_2 equal to 10 % and 50 % of F_p, and s_1 and s_2 the
/// extensions at which F last rises through them before s_p. For a knot that slides and then locks, this is the
/// stiffness of the lock. Empty where F is never as low as F_1.
std::optional<double> chord_stiffness(const Pull& pull);

/// Secant stiffness (F_p - F_0)/(s_p - s_0). Empty where the first point is the peak.
std::optional<double> secant_stiffness(const Pull& pull);

/// Tangent stiffness: the largest least-squares slope of F over an interval as long as a tenth of s_p - s_0. The
/// intervals that begin at a point and the one that ends at s_p are compared. Empty where the first point is the peak.
std::optional<double> tangent_stiffness(const Pull& pull);

}  // namespace knot_utm
