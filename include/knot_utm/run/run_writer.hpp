#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/run/record.hpp"
#include "knot_utm/run/samples.hpp"
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
  TestEnd without_end;                ///< how the test ended where its samples do not say so
  std::vector<std::string> warnings;  ///< further ones, one line each
  std::uint64_t missing_at_end = 0;   ///< commands of the test behind the last that was recorded
  bool ran_here = true;               ///< whether this process ran the test, so that its memory is the test's
};

struct MadeResults {
  Results results;
  RunFacts facts;
  std::size_t rows = 0, full_rows = 0;  ///< of curve.csv and curve_full.csv
};

/// Makes the files of a run from samples.csv in its folder, which must be there (begin_run_folder):
///   curve.csv        one row for each reading of the load cell (cell_reading)
///   curve_full.csv   one row for each accepted time step
///   result.yaml, and final_shape.csv where the last shape is known
///   shapes.csv       where records have readings of the rod (ShapeSeries)
/// and a further one. This is done at the end of a test with and without ROS, and by `tensile_test --from-samples`.
/// Throws InvalidInput where there are no samples that can be read, and std::runtime_error where a file cannot be
/// written.
MadeResults make_results(const std::string& folder, const Method& method, const ResultsOptions& options);

}  // namespace knot_utm
