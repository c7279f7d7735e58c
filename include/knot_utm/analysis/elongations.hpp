#pragma once

namespace knot_utm {

/// How much longer a specimen is than its gauge length, loaded and unloaded again.
///
/// Symbols: L_0 gauge length, the distance between the grips where the specimen is first pulled; L_1 that at the
/// outermost place of the last cycle, L_2 that where this cycle ends [m]. All elongations are shares [-]:
///
///   total     (L_1 - L_0)/L_0
///   residual  (L_2 - L_0)/L_0   what has not come back
///   elastic   (L_1 - L_2)/L_0   what has: total = elastic + residual
///   working   (L_1 - L_2)/L_2   of the specimen that is bedded in, over its own length
///
/// They are those of the load, or extension, between which the cycle goes. With the load at its lower end other than
/// zero, "residual" includes what that load stretches beyond L_0.
struct Elongations {
  double total = 0.0, residual = 0.0, elastic = 0.0, working = 0.0;
};

Elongations elongations(double gauge_length, double loaded_length, double unloaded_length);

}  // namespace knot_utm
