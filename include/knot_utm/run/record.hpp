#pragma once

#include <optional>
#include <vector>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {

/// What a picture colours the rod by, beside its tension. A vector is empty where its values are not known.
struct RodReadings {
  Eigen::VectorXd twist_rate;    ///< of each inner node (twist_rates) [rad/m]
  Eigen::VectorXd contact_load;  ///< normal forces on each node per length (TestingMachine::contact_load) [N/m]

  void state(Archive& archive);
};

/// All that is kept of one command. The files of a run are made from its records alone.
struct Record {
  Command command;
  Sample answer;
  std::vector<Sample> steps;            ///< the accepted time steps of this command, in order
  Points shape;                         ///< nodes after the command [m]; no columns where no shape is due
  Eigen::VectorXd tension;              ///< of each edge, tension positive [N]; empty where no shape is due
  std::optional<RodReadings> readings;  ///< where they are asked for and a shape is due
  double wall_time = 0.0;               ///< wall time since the beginning of the test [s]

  void state(Archive& archive);
};

/// The row of curve.csv that belongs to a command; null: none does. It is the answer at a sampling instant of the load
/// cell, and also where the cell was balanced, so that the curve contains its zero. If the rod parted, it is the time
/// step in which it parted; this step ends the curve, and lies between two sampling instants as a rule. A machine that
/// failed gives no row.
const Sample* cell_reading(const Record& record);

/// Whether the rod's shape is part of the record of a command: it is, at every reading of the load cell, and once the
/// rod has parted.
inline bool shape_is_due(const Command& command, const Sample& answer) {
  return command.read_cell || answer.status == BenchStatus::kBroken;
}

}  // namespace knot_utm
