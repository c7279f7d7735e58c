#pragma once

#include "knot_utm/numeric/lanes.hpp"

namespace knot_utm {

/// The unit vectors of a node's position, and of the spin that stands behind it in the fourth lane.
inline constexpr Lanes kAxis[3] = {{1.0, 0.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}};
inline constexpr Lanes kSpin = {0.0, 0.0, 0.0, 1.0};

}  // namespace knot_utm
