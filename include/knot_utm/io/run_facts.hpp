#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "knot_utm/machine/sample.hpp"
#include "knot_utm/machine/test_program.hpp"

namespace knot_utm {

/// What a run says of itself, beside what the curve means.
struct RunFacts {
  EndedBy ended_by = EndedBy::kNotYet;
  std::string reason;                 ///< one line; empty: as programmed
  std::vector<std::string> warnings;  ///< one line each
  bool not_equilibrated = false;      ///< tying did not come to rest in time

  double preload = Sample::kNone;                                          ///< F_p [N]; NaN: nothing was tied
  double tied_knot_distance = Sample::kNone;                               ///< e once tied and released [m]
  std::array<double, 2> tied_excess_length{Sample::kNone, Sample::kNone};  ///< in each knot then [m]

  double max_penetration = 0.0;                 ///< [fraction of radius]
  double fastest_node = 0.0;                    ///< while pulling and holding [m/s]
  double force_balance_error = Sample::kNone;   ///< largest |upper - lower| / peak, once mounted; NaN: no load
  double energy_balance_error = Sample::kNone;  ///< |work - dissipation - stored| / largest work; NaN: no work
  std::uint64_t steps = 0;
  std::uint64_t rejected_steps = 0;
  std::uint64_t newton_iterations = 0;
  double simulated_time = 0.0;    ///< [s]
  double wall_time = 0.0;         ///< [s]
  std::uint64_t peak_memory = 0;  ///< of the process [bytes]
  unsigned seed = 0;              ///< of the load cell's noise
  std::string version;            ///< of this package

  double real_time_factor() const { return wall_time > 0.0 ? simulated_time / wall_time : 0.0; }
};

/// Gathers those facts that the samples hold, one sample after the other.
class RunMonitor {
 public:
  void add(const Sample& sample);

  /// Fills what it knows into `facts`, warnings among it.
  void report(RunFacts& facts) const;

 private:
  Sample first_;
  Sample last_;
  bool started_ = false;
  bool tied_ = false;
  Sample tied_state_;  ///< the last of tie or release
  double deepest_ = 0.0;
  double fastest_node_ = 0.0;
  double peak_force_ = 0.0;
  double largest_difference_ = 0.0;
  double largest_work_ = 0.0;
  bool not_equilibrated_ = false;
};

/// The most memory that this process has held so far [bytes].
std::uint64_t peak_memory();

/// Version of this package, "1.2.3".
std::string version();

}  // namespace knot_utm
