#pragma once

#include <cstddef>
#include <vector>

namespace knot_utm {

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
