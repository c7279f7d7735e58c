#pragma once

#include <optional>
#include <vector>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/rod/rod.hpp"

namespace knot_utm {

/// What a picture colours the rod by, beside its tension.
struct RodReadings {
  Eigen::VectorXd twist_rate;  ///< of each inner node (twist_rates) [rad/m]; empty: not solved for
  Eigen::VectorXd
      contact_load;  ///< of each node, normal forces of strands and rollers per length [N/m]; empty: unknown

  void state(Archive& archive);
};

/// All that is kept of one command: enough to write everything that a run leaves.
struct Record {
  Command command;
  Sample answer;
  std::vector<Sample> steps;            ///< one a time step accepted for this command, in order
  Points shape;                         ///< nodes after the command [m]; without columns where none was due
  Eigen::VectorXd tension;              ///< of each edge, tension positive [N]; empty where no shape is
  std::optional<RodReadings> readings;  ///< where they were asked for, and a shape is
  double wall_time = 0.0;               ///< since the test began [s]

  void state(Archive& archive);
};

/// What the load cell's record of the test gets of a command, a row of curve.csv: the answer at a sampling instant, and
/// where the cell was balanced, so that the record has its zero; where the rod parted, between two readings as a rule,
/// the time step that parted it, with which the record ends. None at other times, and of a bench that failed.
const Sample* cell_reading(const Record& record);

/// Whether the rod's shape belongs into the record of a command: at every reading of the load cell.
inline bool shape_is_due(const Command& command) { return command.read_cell; }

}  // namespace knot_utm
