#pragma once

#include <optional>
#include <string>
#include <vector>

#include "knot_utm/machine/sample.hpp"

namespace knot_utm {

/// What a testing machine takes for a break: the `ends` section of a method. It judges loads only; that a rod of the
/// simulation parts is known for itself.
struct BreakDetection {
  double arming_load = 0.0;                ///< nothing counts before the load was this [N]
  std::optional<double> fraction_of_peak;  ///< the load fell to this fraction of the peak [-]
  std::optional<double> sharp_drop;        ///< it fell by this fraction of the peak ...
  double sharp_drop_time = 0.1;            ///< ... within this time [s]
  std::optional<double> drop;              ///< it fell by this fraction of the peak ...
  double drop_extension = 1e-3;            ///< ... while the extension grew by no more than this [m]

  bool on() const { return fraction_of_peak || sharp_drop || drop; }
};

/// Watches the loads of one way outwards. It takes the largest and the least load of every time step of the physics
/// (Sample::highest_load, lowest_load), not the cell's readings: a drop between two readings is seen.
class BreakDetector {
 public:
  explicit BreakDetector(const BreakDetection& detection) : detection_(detection) {}

  void begin();  ///< a way outwards: nothing was seen yet

  /// Empty, or what in this sample, the next one, is a break.
  std::string judge(const Sample& sample);

  void state(Archive& archive);

 private:
  struct Seen {
    double time, extension, load;  // the largest of a command [s], [m], [N]
    void state(Archive& archive) { archive(time, extension, load); }
  };
  /// Largest load of the commands since the first one that `counts`.
  template <class Counts>
  double largest(Counts counts) const;
  void forget_what_is_past(const Sample& sample);

  BreakDetection detection_;
  double peak_ = 0.0;       // [N]
  std::vector<Seen> seen_;  // as far back as a drop may reach
};

}  // namespace knot_utm
