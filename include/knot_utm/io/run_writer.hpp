#pragma once

#include <string>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/io/csv.hpp"
#include "knot_utm/io/method.hpp"
#include "knot_utm/io/record.hpp"
#include "knot_utm/io/result_yaml.hpp"
#include "knot_utm/io/run_facts.hpp"
#include "knot_utm/io/shape_series.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/topology/loop_turn.hpp"

namespace knot_utm {

/// Everything that one run leaves in its folder, headless or recorded:
///   method.yaml      from the beginning; with the centreline beside it as specimen.csv where the specimen is a file
///   curve.csv        one row a reading of the load cell (cell_reading)
///   curve_full.csv   one row an accepted time step
///   result.yaml, final_shape.csv   at the end; until then the folder has none, not even those of an earlier run
///   shapes.csv       with those two, where records have readings of the rod (ShapeSeries)
///
/// Make it once all input is known to be right and a JournalWriter holds the folder.
/// Everything throws std::runtime_error where a file cannot be written.
class RunWriter {
 public:
  /// Makes the folder. Throws InvalidInput (key "--out") where that cannot be done.
  RunWriter(const std::string& folder, const Method& method);

  /// One answer of the bench. That of a bench that failed adds the steps that it still made only.
  void add(const Record& record);

  /// Writes result.yaml and, unless there are no points, final_shape.csv, and shapes.csv. `facts` as `facts()` with
  /// what only the caller knows.
  void finish(const Results& results, const RunFacts& facts, const Points& final_shape);

  RunFacts facts() const;                   ///< what the method, the shapes and this process say
  Results results(EndedBy ended_by) const;  ///< what the time steps and readings so far mean

  std::size_t rows() const { return curve_.rows(); }            ///< of curve.csv
  std::size_t full_rows() const { return full_curve_.rows(); }  ///< of curve_full.csv

 private:
  std::string folder_;
  RunFacts known_;
  std::vector<Sample> samples_;              ///< every time step, that of an answer as it was answered
  std::vector<Sample> readings_;             ///< of the load cell: the rows of curve.csv
  double weight_per_length_ = 0.0;           ///< of the rod [N/m]
  double length_ = 0.0;                      ///< of the rod as it was last seen [m]
  LoopTurn turn_;                            ///< since it was mounted, of a loop on rollers
  std::optional<double> radius_on_rollers_;  ///< of the rod [m]; empty: it is not a loop on rollers
  bool far_side_held_ = false;
  CurveWriter curve_;
  CurveWriter full_curve_;
  ShapeSeries shapes_;
};

}  // namespace knot_utm
