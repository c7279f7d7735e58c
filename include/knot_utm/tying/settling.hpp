#pragma once

#include <algorithm>

#include "knot_utm/rod/material.hpp"
#include "knot_utm/specimen/scales.hpp"

namespace knot_utm {

/// How a drawn shape settles before it is tied: under a strong drag that fades. The energy of the drawn shape is an
/// artefact of the drawing and would otherwise throw the strands about.
class Settling {
 public:
  static constexpr double kTime = 0.3;   ///< [s]
  static constexpr double kWave = 17.0;  ///< waves of this length relax in about a tenth of it [h]

  explicit Settling(const RodMaterial& material) : drag_(settling_drag(material, kWave * material.radius, kTime)) {}

  /// So long after it began [s].
  static bool over(double passed) { return passed >= kTime; }
  double drag(double passed) const {
    const double left = std::clamp(1.0 - passed / kTime, 0.0, 1.0);
    return drag_ * left * left;
  }

 private:
  double drag_;  // [N s/m^2]
};

}  // namespace knot_utm
