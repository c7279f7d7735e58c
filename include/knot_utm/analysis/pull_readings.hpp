#pragma once

#include <optional>

#include "knot_utm/analysis/curve_readings.hpp"

namespace knot_utm {

/// What a tester reads off a pull, be it of a knot or of a plain rod. F is straight from point to point; s_p is where F
/// is largest, F_p. The origin is the first point. Energies in J, stiffnesses in N/m; empty: the pull does not have it.

double energy(const Pull& pull);          ///< integral of F over s from the origin to the end
double energy_to_peak(const Pull& pull);  ///< to s_p

/// Mean of F over the second half of the way, where F is steady there: its means over the third and the last quarter
/// differ by no more than 2 %. Empty where it is not, or where there is no way.
std::optional<double> steady_force(const Pull& pull);

/// (F_2 - F_1)/(s_2 - s_1), F_1 and F_2 being 10 % and 50 % of F_p and s_1, s_2 where F last rises through them before
/// s_p: of a knot that slides and locks, the lock. Empty where F is never as low as F_1.
std::optional<double> chord_stiffness(const Pull& pull);

/// (F_p - F_0)/(s_p - s_0) with F_0, s_0 of the origin.
std::optional<double> secant_stiffness(const Pull& pull);

/// The steepest of the least-squares slopes over a tenth of the way from the origin to s_p, of the parts that begin at
/// a point or end at s_p.
std::optional<double> tangent_stiffness(const Pull& pull);

}  // namespace knot_utm
