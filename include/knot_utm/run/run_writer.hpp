#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/run/csv.hpp"
#include "knot_utm/run/samples.hpp"
#include "knot_utm/topology/knot_hole.hpp"
#include "knot_utm/verdict/run_facts.hpp"

namespace knot_utm {

/// The rod over the time of a test, for pictures: what becomes shapes.csv. Of all records that have readings of the rod
/// it keeps each 2^k-th, with the smallest k that leaves no more than `kMost`, and the last one.
class ShapeSeries {
 public:
  static constexpr std::size_t kMost = 120;

  /// `cuts`: edges between one rope and the next (RodProperties::cuts).
  explicit ShapeSeries(const std::vector<int>& cuts = {}) : cuts_(cuts) {}

  void add(const Record& record);  ///< not that of a rod that has parted
  /// As the rod lies once it has parted, when its forces are not known. `time` [s].
  void add_parted(double time, const Points& shape);

  bool empty() const { return kept_.empty(); }

  /// Rows of names and of units, then a row a node, shape after shape, to seven digits; "nan" where something is not
  /// known. `tension` is that of the edge to the next node. Of several ropes there is a column `rope`, from 1.
  std::string csv() const;

 private:
  struct Shape {
    double time = 0.0;  // [s]
    Points points;      // [m]
    Eigen::VectorXd tension;
    RodReadings readings;
  };
  void write(const Shape& shape, std::string& text) const;

  std::vector<int> cuts_;
  std::vector<Shape> kept_;
  std::vector<Shape> at_the_end_;  // the last record where it is not kept, and the parted rod
  std::size_t records_ = 0;
  std::size_t stride_ = 1;  // 2^k
};

struct Centreline;

/// What the samples of a run do not say.
struct ResultsOptions {
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
///   curve.csv        one row for each reading of the load cell (CellReadings)
///   curve_full.csv   one row for each accepted time step
///   result.yaml, and final_shape.csv where the last shape is known
///   shapes.csv       where records have readings of the rod (ShapeSeries)
/// All functions throw std::runtime_error where a file cannot be written.
class RunWriter {
 public:
  /// `drawn`: the specimen before the test (specimen_centreline).
  RunWriter(const std::string& folder, const Method& method, const Centreline& drawn);

  /// Adds one record. If the simulation failed, only the time steps that it still made are added.
  void add(const Record& record);
  /// Writes what is known once the test has ended. `final_shape`: the rod then; no columns: it is not known.
  MadeResults finish(const TestEnd& end, const Points& final_shape, const ResultsOptions& options = {});

 private:
  void add_reading(const Sample& reading);
  std::vector<std::string> warnings_of_turn(double weight) const;  // one, where the loop turned far
  void follow_stop(const Command& command, const Sample& step);

  std::string folder_;
  std::vector<int> cuts_;  // edges between one rope and the next
  RunFacts known_;
  double wall_time_ = 0.0;                   // of the last record [s]
  std::vector<Sample> samples_;              // all accepted time steps; the last one of a command is its answer
  std::vector<int> program_steps_;           // the step of the program of each of them
  std::vector<Sample> readings_;             // readings of the load cell: the rows of curve.csv
  LoopTurn turn_;                            // turning of a loop on rollers since it was mounted
  double passed_stop_ = 0.0, stop_ = 0.0;    // largest share by which a load passed a stop of the crosshead, that stop
  std::optional<double> radius_on_rollers_;  // radius of the rod [m]; empty: the specimen is not a loop on rollers
  double hung_ = 0.0;                        // weight on it [N]
  bool far_side_held_ = false;
  CellReadings cell_readings_;
  CurveWriter curve_, full_curve_;
  ShapeSeries shapes_;
};

/// Makes the same files from samples.csv in the folder of a run: of one under ROS, or by `tensile_test --from-samples`.
MadeResults make_results(const std::string& folder, const Method& method, const ResultsOptions& options);

}  // namespace knot_utm
