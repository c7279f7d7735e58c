#pragma once

#include <optional>
#include <string>

namespace knot_utm {

struct Sample;

/// What a testing machine takes for a break: the load has fallen to a fraction of its peak. It judges loads only. A rod
/// that parts in the simulation (fracture.hpp) ends the test without it.
struct BreakDetection {
  std::optional<double> fraction_of_peak;  ///< [-]; unset: no fall is a break
  double arming_load = 0.0;                ///< falls count only after the load has reached this [N]
};

/// Watches the load while the crosshead moves outwards. It uses the largest and the smallest load over all time steps
/// of a command (Sample::highest_load, lowest_load) and not the cell's readings, so that it sees a drop between two
/// readings.
class BreakDetector {
 public:
  explicit BreakDetector(const BreakDetection& detection) : detection_(detection) {}

  void begin() { peak_ = 0.0; }  ///< begins a motion outwards

  /// Takes the next sample. Returns the break that it shows, as a message; empty: none.
  std::string judge(const Sample& sample);

 private:
  BreakDetection detection_;
  double peak_ = 0.0;  // [N]
};

}  // namespace knot_utm
