#pragma once

#include <cmath>

#include "knot_utm/numeric/lanes.hpp"

namespace knot_utm {

/// Sines and cosines of four angles [rad].
struct SineCosine {
  Lanes sine, cosine;
};

inline SineCosine sine_cosine(const Lanes& angle) {
  SineCosine out;
  for (int k = 0; k < 4; ++k) {
    out.sine[k] = std::sin(angle[k]);
    out.cosine[k] = std::cos(angle[k]);
  }
  return out;
}

}  // namespace knot_utm
