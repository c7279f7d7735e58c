#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/run/csv.hpp"
#include "knot_utm/run/record.hpp"
#include "knot_utm/run/samples.hpp"
#include "knot_utm/run/shape_series.hpp"
#include "knot_utm/topology/loop_turn.hpp"
#include "knot_utm/verdict/result_yaml.hpp"
#include "knot_utm/verdict/run_facts.hpp"

namespace knot_utm {

/// Writes a further file of a run's folder, such as a bag.
struct FurtherWriter {
  std::function<void(const Record&)> add;
  std::function<void()> close;  ///< called after the last record
};

/// What the samples of a run do not say. Functions may be empty.
struct ResultsOptions {
  /// Makes the writer of a further file in this folder.
  std::function<FurtherWriter(const std::string& folder, const Method& method)> further;
  std::function<Margin(const Results&)> margin;  ///< finds the safety margin
  TestEnd without_end;                           ///< how the test ended where its samples do not say so
  std::vector<std::string> warnings;             ///< further ones, one line each
  std::uint64_t missing_at_end = 0;              ///< commands of the test behind the last that was recorded
  bool ran_here = true;  ///< whether this process ran the test, so that its memory is the test's
};

struct MadeResults {
  Results results;
  RunFacts facts;
  std::size_t rows = 0, full_rows = 0;  ///< of curve.csv and curve_full.csv
};

/// Makes the files of a run from samples.csv in its folder: those of RunWriter, and a further one. This is done at the
/// end of a test with and without ROS, and by `tensile_test --from-samples`. Throws InvalidInput where there are no
/// samples that can be read, and std::runtime_error where a file cannot be written.
MadeResults make_results(const std::string& folder, const Method& method, const ResultsOptions& options);

/// Writes what is made of the records of a run into its folder:
///   curve.csv        one row for each reading of the load cell (cell_reading)
///   curve_full.csv   one row for each accepted time step
///   result.yaml, final_shape.csv   at the end
///   shapes.csv       with those two, where records have readings of the rod (ShapeSeries)
///
/// The folder must be there (begin_run_folder). All functions throw std::runtime_error where a file cannot be written.
class RunWriter {
 public:
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
