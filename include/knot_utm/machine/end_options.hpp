#pragma once

#include <optional>

namespace knot_utm {

/// The `ends` section of a method: what ends a test before its program does. A rod that parts, the end of the
/// crosshead's travel (`machine.travel`) and the operator end it in any case.
struct EndOptions {
  std::optional<double> load;                       ///< load limit [N]; unset: the cell's capacity
  std::optional<double> time;                       ///< [s]
  std::optional<double> break_at_fraction_of_peak;  ///< the load has fallen to this fraction of its peak [-]
};

}  // namespace knot_utm
