#pragma once

#include <limits>
#include <string>

namespace knot_utm {

struct SpecimenOptions;

enum class GripKind { kRollers, kNodes, kClamps };

/// Whether the middle of the loop's far side is held half-way between the rollers, or the loop is free to turn on them.
enum class FarSide { kHeld, kFree };

/// Properties of the load cell (load_cell.hpp).
struct LoadCellOptions {
  std::string name;
  double capacity = 50e3;      ///< [N]
  double sampling_rate = 3.0;  ///< [Hz]
  double accuracy = 0.0;       ///< bound on its systematic error [fraction of the reading]
  double floor = 0.0;          ///< below it the accuracy does not hold [of capacity]
  double resolution = 0.0;     ///< [N]; 0: none
  double noise = 0.0;          ///< standard deviation of a reading [N]; 0: none
  unsigned seed = 1;           ///< of the cell: its systematic error, and its noise
  unsigned noise_run = 0;      ///< the same cell has other noise in each run
  std::string notes;
};

/// The `machine` section of a method.
struct MachineOptions {
  GripKind grips = GripKind::kRollers;
  double roller_diameter = 0.0381;    ///< [m]
  double roller_friction = 0.0;       ///< mu of rod on roller [-]
  FarSide far_side = FarSide::kHeld;  ///< of a loop on rollers
  LoadCellOptions load_cell;
  double stiffness = std::numeric_limits<double>::infinity();  ///< frame [N/m]
  double travel = 1.0;                                         ///< the crosshead's reach; a test ends there [m]
};

/// Whether two rollers hold the specimen, which is then a loop. Other grips hold nodes, and clamps their neighbours,
/// too.
bool rollers_hold(const SpecimenOptions& specimen, const MachineOptions& machine);
bool clamps_hold(const SpecimenOptions& specimen, const MachineOptions& machine);
/// Whether the upper grip is a clamp that can be turned about the load axis; that of a loop cannot.
bool clamp_turns(const SpecimenOptions& specimen, const MachineOptions& machine);

}  // namespace knot_utm
