#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "knot_utm/method/method.hpp"
#include "knot_utm/settings/accuracy.hpp"
#include "knot_utm/specimen/machine_options.hpp"
#include "knot_utm/specimen/material.hpp"

namespace knot_utm {

/// What is known of the specimen and its test before anything is simulated.
struct SpecimenFacts {
  Material material;                       ///< material of the rod
  int strands = 1;                         ///< number of strands that bear the load: two of a loop
  double buckling_factor = 0.0;            ///< Euler's load of a straight specimen times L^2/k_b [-]; 0: it is none
  bool may_hold_a_knot = false;            ///< as the specimen is made
  bool follows_type = true;                ///< of its knot
  bool one_knot_in_a_strand = false;       ///< one knot, and the specimen is no loop
  std::size_t free_ends = 0;               ///< of its ropes, that a knot's file describes
  std::vector<std::string> knot_readings;  ///< names of what the knot's file reads
  double dead_load = 0.0;                  ///< constant force on its other end [N]; 0: there is none
  double preload = std::numeric_limits<double>::quiet_NaN();  ///< F_p [N]; NaN: nothing is tied
  double knot_distance = 0.0;         ///< that the pull is to begin with [m]; 0: no knots are tied
  double end_to_end = 0.0;            ///< the same of the specimen's length [m]
  double pull_speed = 0.0;            ///< largest programmed speed of a pull [m/s]; 0: there is none
  double inertia = 1.0;               ///< accelerated mass over the rod's own mass [-]
  LoadCellOptions load_cell;          ///< load cell that reads the forces
  RelativeErrors errors;              ///< relative errors of the readings from mesh and tolerances [-]
  Specification specification;        ///< requirements on the results
  std::vector<std::string> foreseen;  ///< warnings, one line each
};

/// Facts about a run that do not follow from its samples. What follows from the samples is in `Results`.
struct RunFacts : SpecimenFacts {
  std::string reason;                 ///< why the test ended, one line; empty: as programmed
  std::vector<std::string> warnings;  ///< others than foreseen ones and those that follow from the results
  double wall_time = 0.0;             ///< [s]
  std::uint64_t peak_memory = 0;      ///< largest memory of the process [bytes]; 0: not known
  double weight = 0.0;                ///< weight of the rod [N]; 0: no gravity acts
  bool ends_with_hold = false;        ///< the crosshead stands at the end, so that a knot could be measured
  std::optional<double> knot_hole;    ///< hole_diameter at the end of the test, of one knot in a strand [m]
  std::string version;                ///< version of this package
};

/// The largest memory that this process has used so far [bytes].
std::uint64_t peak_memory();

/// The version of this package, such as "1.2.3".
std::string version();

}  // namespace knot_utm
