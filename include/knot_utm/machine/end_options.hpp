#pragma once

#include <optional>

#include "knot_utm/machine/break_detector.hpp"

namespace knot_utm {

/// The `ends` section of a method: what ends a test whatever its program says, beside a rod that parts, the end of the
/// crosshead's way (`machine.travel`) and the operator.
struct EndOptions {
  std::optional<double> load;         ///< load limit [N]; unset: the cell's capacity
  std::optional<double> time;         ///< [s]
  std::optional<double> arming_load;  ///< from which on falls of the load count [N]; unset: 2 % of the cell's capacity
  BreakDetection breaks;              ///< but for its arming load
};

}  // namespace knot_utm
