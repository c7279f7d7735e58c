#pragma once

#include <optional>
#include <string>
#include <vector>

#include "knot_utm/record/sample.hpp"

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
/// (Sample::highest_load, lowest_load), not the cell's readings: a drop between two readings is seen. Within a command
/// nobody knows when; commands are no longer than the windows of a drop (make_program).
class BreakDetector {
 public:
  explicit BreakDetector(const BreakDetection& detection) : detection_(detection) {}

  void begin();  ///< a way outwards: nothing was seen yet

  /// Empty, or what in this sample, the next one, is a break.
  std::string judge(const Sample& sample);

  void state(Archive& archive);

 private:
  /// Largest load over the last so much of time, or of extension: of what was seen, all that may still become it.
  class Window {
   public:
    void clear() { seen_.clear(); }
    double largest(double now, double width) const;
    void add(double now, double width, double load);
    void state(Archive& archive) { archive.list(seen_); }

   private:
    struct Seen {
      double at, load;
      void state(Archive& archive) { archive(at, load); }
    };
    std::vector<Seen> seen_;  // the older, the larger the load
  };

  BreakDetection detection_;
  double peak_ = 0.0;  // [N]
  Window in_time_, in_extension_;
};

}  // namespace knot_utm
