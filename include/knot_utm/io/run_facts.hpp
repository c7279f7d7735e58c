#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "knot_utm/analysis/margin.hpp"
#include "knot_utm/io/report_options.hpp"
#include "knot_utm/machine/accuracy.hpp"
#include "knot_utm/machine/options.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {

/// What a run knows of itself that its samples do not say; what they say is in `Results`.
struct RunFacts {
  std::string reason;                 ///< one line; empty: as programmed
  std::vector<std::string> foreseen;  ///< warnings, one line each, that were known before anything was tied
  std::vector<std::string> warnings;  ///< one line each, beside those that follow from the results
  double preload = Sample::kNone;     ///< F_p [N]; NaN: nothing was tied
  ReadingErrors errors;               ///< of the readings, as fractions of them
  Margin margin;                      ///< where it was asked for
  double wall_time = 0.0;             ///< [s]
  std::uint64_t peak_memory = 0;      ///< of the process [bytes]; 0: not known
  double inertia = 1.0;               ///< mass that is accelerated, over the rod's own [-]
  double weight = 0.0;                ///< of the rod where gravity acts on it [N]
  double slid_along = 0.0;            ///< of a loop on rollers along their axes, at most [m]
  Material material;                  ///< of the rod
  int strands = 1;                    ///< that bear the load, two of a loop
  bool may_hold_a_knot = false;       ///< as the specimen is made
  bool one_knot_in_a_strand = false;  ///< a knot of its own, and no loop
  std::optional<double> knot_hole;    ///< hole_diameter at the end of the test, of one knot in a strand [m]
  double dead_load = 0.0;             ///< that pulls the specimen's other end [N]; 0: none does
  double knot_distance = 0.0;         ///< that the knots were to be tied at [m]; 0: none were tied
  double pull_speed = 0.0;            ///< the largest that is programmed [m/s]; 0: none is
  LoadCellOptions load_cell;          ///< that read the forces
  Specification specification;        ///< what the user asks of the results
  std::string version;                ///< of this package
};

/// The most memory that this process has held so far [bytes].
std::uint64_t peak_memory();

/// Version of this package, "1.2.3".
std::string version();

}  // namespace knot_utm
