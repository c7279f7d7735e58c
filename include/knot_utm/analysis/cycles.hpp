#pragma once

#include <cstddef>
#include <vector>

namespace knot_utm {

/// One reading of a specimen that is moved to and fro.
struct PathPoint {
  double extension;  ///< s [m]
  double force;      ///< F [N]
};
using Path = std::vector<PathPoint>;

/// Out and back, from one point of a path to another.
struct Cycle {
  std::size_t begin, end;

  /// Area that loading and unloading enclose [J]: the integral of F over s around it, from its end straight back to its
  /// beginning. Positive: more work was put in than came back.
  double hysteresis = 0.0;
};

/// The cycles of a path, in order. It turns where s is largest or smallest before it goes back by a tenth of all its
/// range of s, less is noise; beginning and end of the path are turning points too. A cycle goes from a point where it
/// turns outwards to the next such. The first one may be the way to where cycles begin, the last one may be cut off:
/// they count where s, or F, comes back to within a tenth of its range in the cycle.
std::vector<Cycle> closed_cycles(const Path& path);

}  // namespace knot_utm
