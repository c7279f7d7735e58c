#pragma once

#include <functional>
#include <string>
#include <vector>

#include "knot_utm/analysis/statistics.hpp"
#include "knot_utm/io/method.hpp"
#include "knot_utm/study/headless_run.hpp"

namespace knot_utm {

/// How a batch, all specimens of a method, is run. A function that is empty is not called, except `interrupted`.
struct BatchOptions {
  std::string folder;
  int jobs = 1;                    ///< specimens that are tested side by side
  bool resume = false;             ///< goes on with the batch that was cut off in `folder`
  bool overwrite = false;          ///< writes over what `folder` holds, instead of to the next free one
  bool shapes = false;             ///< also writes shapes.csv of each specimen
  double checkpoint_period = 5.0;  ///< wall time between two checkpoints of a specimen [s]; 0: none

  std::function<bool()> interrupted;                    ///< asked by several threads
  std::function<void(const std::string& line)> notice;  ///< warnings, once all tests have ended
  /// After each test that has ended: how many of how many.
  std::function<void(int ended, int count)> progress;
};

/// A specimen whose readings do not count, and why: "the knot came undone before it was pulled".
struct Rejected {
  int specimen = 0;
  std::string reason;
};

struct BatchOutcome {
  std::string folder;
  bool interrupted = false;  ///< it can be resumed, and has no statistics yet
  int specimens = 0;
  std::vector<Rejected> rejected;
};

/// The folder of a specimen in that of its batch: FOLDER/specimen_001.
std::string specimen_folder(const std::string& folder, int number);

/// Tests all specimens of a method and writes, into a folder each, what a single test writes; then specimens.csv with
/// a row for each, and statistics.yaml. Both are the same, to the byte, however many were tested side by side. A test
/// whose physics gave up, or whose knot came undone before it was pulled, is rejected: its readings are left out of the
/// statistics. Throws InvalidInput where a specimen would be refused, before anything is written, and
/// std::runtime_error where a file cannot be written: the batch can then be resumed.
BatchOutcome run_batch(const Method& method, const BatchOptions& options);

}  // namespace knot_utm
