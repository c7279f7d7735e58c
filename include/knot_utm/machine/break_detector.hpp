#pragma once

#include <optional>
#include <string>
#include <vector>

#include "knot_utm/numeric/archive.hpp"

namespace knot_utm {

struct Sample;

/// What a testing machine takes for a break: the `ends` section of a method. It judges loads only. A rod that parts in
/// the simulation (fracture.hpp) ends the test without it.
struct BreakDetection {
  double arming_load = 0.0;                ///< falls count only after the load has reached this [N]
  std::optional<double> fraction_of_peak;  ///< the load fell to this fraction of the peak [-]
  std::optional<double> sharp_drop;        ///< it fell by this fraction of the peak ...
  double sharp_drop_time = 0.1;            ///< ... within this time [s]
  std::optional<double> drop;              ///< it fell by this fraction of the peak ...
  double drop_extension = 1e-3;            ///< ... while the extension grew by no more than this [m]

  bool on() const { return fraction_of_peak || sharp_drop || drop; }
};

/// Watches the load while the crosshead moves outwards. It uses the largest and the smallest load over all time steps
/// of a command (Sample::highest_load, lowest_load) and not the cell's readings, so that it sees a drop between two
/// readings. Times within a command are not known; commands are therefore no longer than the windows of a drop
/// (make_program).
class BreakDetector {
 public:
  explicit BreakDetector(const BreakDetection& detection) : detection_(detection) {}

  void begin();  ///< begins a motion outwards

  /// Takes the next sample. Returns the break that it shows, as a message; empty: none.
  std::string judge(const Sample& sample);

  void state(Archive& archive);

 private:
  /// Largest load over the last `width` of time or of extension. It keeps only loads that may still become the largest.
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
