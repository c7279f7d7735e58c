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
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/topology/loop_turn.hpp"

namespace knot_utm {

struct Sample;

/// Writes all files of a run into its folder, in a test without ROS as well as in the recorder:
///   method.yaml      from the beginning, with the centreline beside it as specimen.csv where the specimen is a file
///   curve.csv        one row for each reading of the load cell (cell_reading)
///   curve_full.csv   one row for each accepted time step
///   result.yaml, final_shape.csv   at the end; until then the folder has none, not even those of an earlier run
///   shapes.csv       with those two, where records have readings of the rod (ShapeSeries)
///
/// Make it once all input has been checked and a JournalWriter holds the folder. All functions throw std::runtime_error
/// where a file cannot be written.
class RunWriter {
 public:
  /// Makes the folder. Throws InvalidInput (key "--out") where that cannot be done.
  RunWriter(const std::string& folder, const Method& method);

  /// Adds one record. If the simulation failed, only the time steps that it still made are added.
  void add(const Record& record);

  /// Writes result.yaml and, unless `final_shape` is empty, final_shape.csv; and shapes.csv where there are shapes.
  /// `facts`: the result of `facts()`, completed by what only the caller knows.
  void finish(const Results& results, const RunFacts& facts, const Points& final_shape);

  RunFacts facts() const;                   ///< facts that follow from the method, the shapes and this process
  Results results(EndedBy ended_by) const;  ///< results of the time steps and readings so far

  std::size_t rows() const { return curve_.rows(); }            ///< rows of curve.csv
  std::size_t full_rows() const { return full_curve_.rows(); }  ///< rows of curve_full.csv

 private:
  RunWriter(const std::string& folder, const Method& method, double inertia);

  std::string folder_;
  RunFacts known_;
  std::vector<Sample> samples_;              ///< all accepted time steps; the last one of a command is its answer
  std::vector<Sample> readings_;             ///< readings of the load cell: the rows of curve.csv
  double weight_per_length_ = 0.0;           ///< weight of the rod per length [N/m]
  double length_ = 0.0;                      ///< length of the rod in the last known shape [m]
  LoopTurn turn_;                            ///< turning of a loop on rollers since it was mounted
  std::optional<double> radius_on_rollers_;  ///< radius of the rod [m]; empty: the specimen is not a loop on rollers
  bool far_side_held_ = false;
  CurveWriter curve_;
  CurveWriter full_curve_;
  ShapeSeries shapes_;
};

}  // namespace knot_utm
