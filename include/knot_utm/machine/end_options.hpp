#pragma once

#include <optional>

#include "knot_utm/machine/break_detector.hpp"

namespace knot_utm {

/// The `ends` section of a method: what ends a test before its program does. A rod that parts, the end of the
/// crosshead's travel (`machine.travel`) and the operator end it in any case.
struct EndOptions {
  std::optional<double> load;         ///< load limit [N]; unset: the cell's capacity
  std::optional<double> time;         ///< [s]
  std::optional<double> arming_load;  ///< load from which falls of it count [N]; unset: 2 % of the cell's capacity
  BreakDetection breaks;              ///< its arming load is not used
};

}  // namespace knot_utm
