#pragma once

#include <cstddef>
#include <optional>
#include <vector>

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

struct Results;
struct Sample;

/// One reading of a specimen that is loaded and unloaded.
struct PathPoint {
  double extension;        ///< s [m]
  double force;            ///< F [N]
  double crosshead = 0.0;  ///< its displacement [m]
};
using Path = std::vector<PathPoint>;

/// A cycle: outwards and back, from one point of a path to another.
struct Cycle {
  /// Indices of its first and last point.
  std::size_t begin, end;

  /// Hysteresis loss: the area enclosed by loading and unloading [J]. It is the integral of F over s from the cycle's
  /// beginning to its end, and straight back to its beginning. Positive: more work was put in than came back.
  double hysteresis = 0.0;
};

/// The closed cycles of a path, in order.
///
/// A turning point is a point at which the crosshead turns. In a step that cycles it does so at the ends of the cycles
/// alone, however small they are beside the way on which the step first took up slack. The first and the last point of
/// the path are turning points, too. A cycle goes from a turning point at which s begins to grow to the next such
/// point.
///
/// Cycles that begin or end with the path may be incomplete: the first may be the approach to the first turning point,
/// and the last may be cut off. They count only if s or F returns to within a tenth of its range in the cycle.
std::vector<Cycle> closed_cycles(const Path& path);

/// The state that a phase begins from: the sample before its first, balanced as that one is. A balance in between has
/// left the specimen as it was: s = 0 and F = balance_offset by its definition.
Sample origin_at(const Sample& first, Sample before);

/// Reads the relaxation in the last hold, and the cycles of the last step that cycles, with the elongations of the last
/// of them over the gauge length of `results`. `steps`: as of analyse().
void read_holds_and_cycles(const std::vector<Sample>& samples, const std::vector<int>& steps, Results& results);

}  // namespace knot_utm
