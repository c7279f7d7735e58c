#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/run/csv.hpp"
#include "knot_utm/run/record.hpp"
#include "knot_utm/run/samples.hpp"
#include "knot_utm/run/shape_series.hpp"
#include "knot_utm/topology/loop_turn.hpp"
#include "knot_utm/verdict/run_facts.hpp"

namespace knot_utm {

struct Centreline;

/// Writes a further file of a run's folder, such as a bag.
struct FurtherWriter {
  std::function<void(const Record&)> add;
  std::function<void()> close;  ///< called after the last record
};
/// Makes the writer of a further file in this folder.
using MakeFurther = std::function<FurtherWriter(const std::string& folder, const Method& method)>;

/// What the samples of a run do not say.
struct ResultsOptions {
  MakeFurther further;                ///< may be empty
  TestEnd without_end;                ///< how the test ended where its samples do not say so
  std::vector<std::string> warnings;  ///< further ones, one line each
  bool ran_here = true;               ///< whether this process ran the test, so that its memory is the test's
};

struct MadeResults {
  Results results;
  RunFacts facts;
  std::size_t rows = 0, full_rows = 0;  ///< of curve.csv and curve_full.csv
};

/// Makes the files of a run from its records, in the folder that it has begun (begin_run_folder):
///   curve.csv        one row for each reading of the load cell (cell_reading)
///   curve_full.csv   one row for each accepted time step
///   result.yaml, and final_shape.csv where the last shape is known
///   shapes.csv       where records have readings of the rod (ShapeSeries)
/// and a further one. All functions throw std::runtime_error where a file cannot be written.
class RunWriter {
 public:
  RunWriter(const std::string& folder, const Method& method, const MakeFurther& further = nullptr);

  /// Adds one record. If the simulation failed, only the time steps that it still made are added.
  void add(const Record& record);
  /// Writes what is known once the test has ended. `final_shape`: the rod then; no columns: it is not known.
  MadeResults finish(const TestEnd& end, const Points& final_shape, const ResultsOptions& options = {});

 private:
  RunWriter(const std::string& folder, const Method& method, const Centreline& drawn);
  void add_to_files(const Record& record);
  RunFacts facts() const;
  void write_ends(const Results& results, RunFacts facts, const Points& final_shape);

  std::string folder_;
  FurtherWriter further_;
  std::vector<int> cuts_;  // edges between one rope and the next
  RunFacts known_;
  double wall_time_ = 0.0;                   // of the last record [s]
  std::vector<Sample> samples_;              // all accepted time steps; the last one of a command is its answer
  std::vector<int> program_steps_;           // the step of the program of each of them
  std::vector<Sample> readings_;             // readings of the load cell: the rows of curve.csv
  double weight_per_length_ = 0.0;           // weight of the rod per length [N/m]
  double length_ = 0.0;                      // length of all ropes in the last known shape [m]
  LoopTurn turn_;                            // turning of a loop on rollers since it was mounted
  std::optional<double> radius_on_rollers_;  // radius of the rod [m]; empty: the specimen is not a loop on rollers
  double hung_ = 0.0;                        // weight on it [N]
  bool far_side_held_ = false;
  CurveWriter curve_, full_curve_;
  ShapeSeries shapes_;
};

/// Makes the same files of a run from samples.csv in its folder: of one that was cut off, of one under ROS, and by
/// `tensile_test --from-samples`. Throws InvalidInput where there are no samples that can be read.
MadeResults make_results(const std::string& folder, const Method& method, const ResultsOptions& options);

}  // namespace knot_utm
